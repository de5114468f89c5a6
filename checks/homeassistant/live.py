"""Runs a complete Home Assistant with a broker, and prints its MQTT entities with their numbers of changes and of ON states.

    python live.py HOST PORT SECONDS
"""

import asyncio
import json
import sys
import tempfile
import time
from pathlib import Path
from unittest.mock import MagicMock

from homeassistant import bootstrap, config_entries, loader
from homeassistant.const import EVENT_STATE_CHANGED
from homeassistant.core import HomeAssistant, callback
from homeassistant.helpers import area_registry, device_registry, entity_registry


async def main(host, port, seconds):
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "configuration.yaml").touch()
        hass = HomeAssistant(folder)
        hass.config.skip_pip = True
        loader.async_setup(hass)
        hass.config_entries = config_entries.ConfigEntries(hass, {})
        await bootstrap.async_load_base_functionality(hass)
        # The frontend is not needed here.
        hass.config.components.update({"http", "file_upload"})
        hass.http = MagicMock()
        changes, ons = {}, {}

        @callback
        def changed(event):
            entity, state = event.data["entity_id"], event.data["new_state"]
            changes[entity] = changes.get(entity, 0) + 1
            if state is not None and state.state == "on":
                ons[entity] = ons.get(entity, 0) + 1

        hass.bus.async_listen(EVENT_STATE_CHANGED, changed)
        entry = config_entries.ConfigEntry(
            version=1, minor_version=1, domain="mqtt", title="", source="user",
            data={"broker": host, "port": port, "discovery": True},
        )
        await hass.config_entries.async_add(entry)
        await hass.async_start()
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            await asyncio.sleep(1)
        await hass.async_block_till_done()
        devices = device_registry.async_get(hass)
        entities = entity_registry.async_get(hass)
        areas = area_registry.async_get(hass)
        for state in sorted(hass.states.async_all(), key=lambda state: state.entity_id):
            known = entities.async_get(state.entity_id)
            device = devices.async_get(known.device_id) if known and known.device_id else None
            area = areas.async_get_area(device.area_id) if device and device.area_id else None
            print(json.dumps({
                "entity": state.entity_id,
                "class": state.attributes.get("device_class"),
                "state": state.state,
                "seq": state.attributes.get("seq"),
                "changes": changes.get(state.entity_id, 0),
                "ons": ons.get(state.entity_id, 0),
                "area": area.name if area else None,
            }))
        await hass.async_stop(force=True)


asyncio.run(main(sys.argv[1], int(sys.argv[2]), float(sys.argv[3])))
