"""Checks discovery messages with Home Assistant's own schemas, and states with the messages.

    python schemas.py kept.jsonl

Each line of the file is an object with `topic` and `payload`: a retained message of a broker. README.md describes how to get them.
"""

import asyncio
import json
import re
import sys
import tempfile

from homeassistant.components.mqtt import abbreviations, binary_sensor, sensor, switch
from homeassistant.core import HomeAssistant
from homeassistant.helpers.template import Template

SCHEMAS = {
    "binary_sensor": binary_sensor.DISCOVERY_SCHEMA,
    "sensor": sensor.DISCOVERY_SCHEMA,
    "switch": switch.DISCOVERY_SCHEMA,
}
TOPIC = re.compile(r"^(?P<prefix>.+)/(?P<component>\w+)/(?P<object>[a-zA-Z0-9_-]+)/config$")
# The components of a device may share these keys.
SHARED = ("availability", "availability_topic", "availability_mode", "state_topic", "command_topic", "qos", "encoding")

try:
    # Home Assistant 2024.11 and later.
    from homeassistant.components.mqtt.discovery import DEVICE_DISCOVERY_SCHEMA
except ImportError:
    DEVICE_DISCOVERY_SCHEMA = None


def entities(topic, payload):
    """The entities of a discovery message: kind and configuration."""
    found = TOPIC.match(topic)
    if not found:
        raise ValueError("this is not a discovery topic")
    config = json.loads(payload)
    if found["component"] != "device":
        return [(found["component"], config)]
    if DEVICE_DISCOVERY_SCHEMA is not None:
        DEVICE_DISCOVERY_SCHEMA(json.loads(payload))
    unknown = set(config) - {"device", "origin", "components", *SHARED}
    if unknown or not config["device"]["identifiers"] or not config["origin"]["name"]:
        raise ValueError(f"a device needs identifiers and an origin with a name, without other keys: {unknown}")
    shared = {key: config[key] for key in SHARED if key in config}
    all_of_it = []
    for component in config["components"].values():
        component = dict(component)
        kind = component.pop("platform")
        if "unique_id" not in component:
            raise ValueError("an entity of a device needs a unique_id")
        all_of_it.append((kind, {**shared, "device": config["device"], "origin": config["origin"], **component}))
    return all_of_it


def states(hass, config, kept):
    """Raises an error if the last message of the entity's topic does not fit its configuration."""
    topic = config.get("state_topic")
    if topic not in kept or "command_topic" in config:
        return
    template = config.get("value_template")
    said = kept[topic]
    if template is not None:
        text = template.template if isinstance(template, Template) else template
        said = Template(text, hass).async_render_with_possible_json_value(said, "")
    said = str(said)
    if said == "None":
        # A device of Zigbee2MQTT sends all values at once, also unknown ones.
        return
    if "payload_on" in config and said not in (str(config["payload_on"]), str(config["payload_off"])):
        raise ValueError(f"{said!r} is neither the on nor the off payload")
    if config.get("options") and said not in config["options"]:
        raise ValueError(f"{said!r} is not one of {config['options']}")
    if config.get("state_class"):
        float(said)


async def main(hass):
    with open(sys.argv[1], encoding="utf-8") as lines:
        kept = {message["topic"]: message["payload"] for message in map(json.loads, lines)}
    wrong, checked, unique = [], 0, set()
    assert abbreviations.ABBREVIATIONS
    for topic, payload in kept.items():
        if not topic.endswith("/config"):
            continue
        try:
            for kind, config in entities(topic, payload):
                config = SCHEMAS[kind](config)
                if config["unique_id"] in unique:
                    raise ValueError("two entities have the same unique_id")
                unique.add(config["unique_id"])
                states(hass, config, kept)
                checked += 1
        except Exception as error:  # Each error is reported.
            wrong.append(f"{topic}: {error}")
    print(f"{checked} entities agree with Home Assistant, {len(wrong)} messages do not")
    print("\n".join(wrong))
    return 1 if wrong or checked == 0 else 0


async def checked_by_home_assistant():
    with tempfile.TemporaryDirectory() as folder:
        return await main(HomeAssistant(folder))


sys.exit(asyncio.run(checked_by_home_assistant()))
