"""The notebooks, cell by cell, as they are."""

import json
import os
from pathlib import Path
from typing import Any

import pytest

NOTEBOOKS = sorted((Path(__file__).parent.parent / "notebooks").glob("*.ipynb"))


def lived(notebook: Path) -> dict[str, Any]:
    """What is known once all cells have run."""
    known: dict[str, Any] = {}
    for number, cell in enumerate(json.loads(notebook.read_text())["cells"]):
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"{notebook.name}, cell {number}", "exec"), known)  # noqa: S102
    return known


def named(name: str) -> Path:
    return next(notebook for notebook in NOTEBOOKS if notebook.stem == name)


def test_a_recogniser_is_better_than_guessing() -> None:
    known = lived(named("recogniser"))
    assert known["accuracy"] > known["of_guessing"] + 0.1


def test_an_illness_shows_beside_the_twin() -> None:
    known = lived(named("illness"))
    assert known["first"] == pytest.approx(1, abs=0.02) and known["last"] < known["first"] - 0.02


def test_sensors_that_are_placed_see_more_than_by_chance() -> None:
    known = lived(named("placement"))
    assert known["seen"] > sum(known["by_chance"]) / len(known["by_chance"])


def test_simulated_days_teach_what_holds_in_a_home_that_they_are_not_of(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("HOMEBODY_DATA", raising=False)
    known = lived(named("transfer"))
    f1 = known["result"]["macro F1"]
    assert not known["is_real"] and known["out"] is None
    assert f1["simulated days"] > f1["always the most usual"] + 0.1
    assert f1["all real days but the one"] > f1["simulated days"], "nothing of what is judged was seen"


def test_simulated_days_teach_what_holds_in_a_real_home() -> None:
    if not (Path(os.environ.get("HOMEBODY_DATA", "nowhere")) / "casas_hh111_week1").is_dir():
        pytest.skip("HOMEBODY_DATA names no folder with casas_hh111_week1")
    known = lived(named("transfer"))
    f1 = known["result"]["macro F1"]
    assert known["is_real"] and f1["simulated days"] > f1["always the most usual"] + 0.3
    assert f1["the first real days"] > f1["always the most usual"] + 0.3


def test_all_notebooks_are_run_here() -> None:
    assert [notebook.stem for notebook in NOTEBOOKS] == ["illness", "placement", "recogniser", "transfer"]
