"""Runs, their tables, and what is wrong with what is asked."""

import subprocess
import sys
import threading
import time
import types
from pathlib import Path

import homebody as hb
import pandas
import polars
import pyarrow
import pytest


@pytest.fixture(scope="module")
def run() -> hb.Run:
    return hb.scenario("tigerplace").run(days=2, seed=7)


def test_the_same_seed_is_the_same_run_and_another_is_another(run: hb.Run) -> None:
    home = hb.scenario("tigerplace")
    again, other = home.run(days=2, seed=7), home.run(days=2, seed=8)
    assert again.summary["sha256"] == run.summary["sha256"] != other.summary["sha256"]
    assert again.events.to_pandas().equals(run.events.to_pandas())


def test_tables_have_the_shapes_that_people_know(run: hb.Run) -> None:
    events = run.events.to_pandas()
    assert list(events.columns) == ["time", "device", "value"]
    assert str(events["time"].dt.tz) == run.time_zone == "America/Chicago"
    assert len(events) == run.summary["rows"] > 1000
    assert events["time"].is_monotonic_increasing
    activities = run.activities.to_pandas()
    assert list(activities.columns) == ["start_time", "end_time", "activity", "resident"]
    of_one = activities[activities["resident"] == "margaret"]
    assert (of_one["start_time"].iloc[1:].array >= of_one["end_time"].iloc[:-1].array).all(), "none overlap"
    assert len(run.movement) > len(activities)
    known = run.to_pyadlml()
    assert known.devices["time"].dt.tz is None and known.devices["value"].isin([True, False]).any()


def test_pandas_polars_and_pyarrow_have_the_same_rows(run: hb.Run) -> None:
    events = run.events
    assert len(events.to_pandas()) == len(events.to_polars()) == events.to_pyarrow().num_rows == len(events)
    assert events.to_polars()["time"].to_list() == events.to_pandas()["time"].to_list()
    frame = polars.DataFrame(events)
    assert frame["device"].cast(str).to_list() == events.to_pandas()["device"].astype(str).to_list()


def address(column: pyarrow.ChunkedArray) -> int:
    """Where the values of a column of numbers or times lie in memory."""
    return column.chunk(0).buffers()[1].address + column.chunk(0).offset * column.type.bit_width // 8


def in_polars(series: polars.Series) -> int:
    """The same of polars; it raises where this cannot be without a copy."""
    return series.to_physical().to_numpy(allow_copy=False).__array_interface__["data"][0]


def test_polars_and_pyarrow_take_numbers_and_times_without_a_copy(run: hb.Run) -> None:
    taken = []
    for table in (run.events, run.movement, run.activities, run.windows("5m")):
        arrow, frame = pyarrow.table(table), table.to_polars()
        for name, column in zip(arrow.column_names, arrow.columns):
            is_number = pyarrow.types.is_primitive(column.type) and not pyarrow.types.is_boolean(column.type)
            if is_number and column.null_count == 0:
                assert in_polars(frame[name]) == address(column), name
                taken.append(name)
        assert address(pyarrow.table(table).column(taken[-1])) == address(arrow.column(taken[-1]))
    assert {"time", "start_time", "end_time", "hour"} < set(taken) and len(taken) > 15
    events = run.events.to_polars()
    assert in_polars(events["time"].dt.offset_by("0s")) != in_polars(events["time"]), "a copy lies elsewhere"
    assert address(pyarrow.table(hb.read(run.folder).events)["time"]) != address(pyarrow.table(run.events)["time"])


def test_windows_count_what_was_said(run: hb.Run) -> None:
    windows = run.windows("1h").to_pandas()
    sensors = [column for column in windows.columns if column in run.sensors]
    assert len(sensors) == len(run.sensors)
    begins = run.events.to_pandas()
    begins = begins[~begins["value"].isin(["OFF", "OUT", "CLOSE"])]
    assert windows[sensors].to_numpy().sum() == len(begins)
    assert set(windows["label"].dropna()) <= set(run.activities.to_pandas()["activity"])
    assert set(windows["resident"]) == {"margaret"}
    with pytest.raises(ValueError, match="span"):
        run.windows("60 parsecs")


def test_labels_are_those_of_the_command(run: hb.Run, tmp_path: Path) -> None:
    labelled = run.labelled().to_pandas()
    assert len(labelled) == len(run.events)
    assert list(labelled.columns)[:3] == ["time", "device", "value"]
    assert labelled["time"].tolist() == run.events.to_pandas()["time"].tolist()
    command = [sys.executable, "-m", "homebody", "label", str(run.folder), "--out", f"csv:{tmp_path / 'labelled.csv'}"]
    subprocess.run(command, check=True, capture_output=True)
    told = pandas.read_csv(tmp_path / "labelled.csv", keep_default_na=False)
    assert labelled["activity"].astype(object).fillna("").tolist() == told["activity"].tolist()


def test_pictures_are_drawn(run: hb.Run, tmp_path: Path) -> None:
    home = run.scenario
    pictures = [run.day(0).plot(), run.density().plot(), home.coverage().plot(), home.plan.plot(), run.measures().plot()]
    for number, picture in enumerate(pictures):
        assert picture.save(tmp_path / f"{number}.png").read_bytes().startswith(b"\x89PNG")
        assert picture._repr_svg_().startswith("<svg")
    with pytest.raises(ValueError, match="path"):
        pictures[0].save(tmp_path / "a.gif")
    with pytest.raises(hb.HomebodyError, match="x.png: No such file or directory\n  hint: .*nodir is not a folder"):
        pictures[0].save(tmp_path / "nodir" / "x.png")
    with pytest.raises(ValueError, match="day is 99: the log goes from 2009-03-02 to 2009-03-03"):
        run.day(99)
    with pytest.raises(ValueError, match='day is "second": "second" is not a date'):
        run.day("second")


def test_a_log_of_another_place_is_read_and_compared(run: hb.Run, tmp_path: Path) -> None:
    text = tmp_path / "home.txt"
    lines = ["2011-06-15 00:05:32.000000\tM003\tON", "2011-06-15 00:05:36.500000\tM003\tOFF"]
    text.write_text("\n".join(lines) + "\n")
    log = hb.read(text)
    assert log.time_zone is None and log.events.to_pandas()["time"].dt.tz is None, "nobody knows the zone"
    there = hb.read(text, time_zone="America/Los_Angeles").events.to_pandas()
    assert str(there["time"][0]) == "2011-06-15 00:05:32-07:00"
    assert hb.compare(run, run).data["agreement_by_sensor"] == 1
    with pytest.raises(hb.LogError):
        hb.read(tmp_path / "nowhere.txt")
    with pytest.raises(ValueError, match="time_zone"):
        hb.read(text, time_zone="Mars/Olympus")


def test_a_log_in_utc_is_compared_on_the_wall_that_it_was_read_for(run: hb.Run, tmp_path: Path) -> None:
    # Three dates of UTC, and two of the home.
    file = tmp_path / "utc.csv"
    told = run.events.to_pandas()
    told["time"] = told["time"].dt.tz_convert("UTC").dt.strftime("%Y-%m-%d %H:%M:%S.%f+00:00")
    told.to_csv(file, index=False)
    log = hb.read(file, "America/Chicago")
    assert log.remarks == [] and hb.read(file).remarks == ["its hours are those of UTC: time_zone tells the home's own"]
    for a, b in ((log, run), (run, log), (log, log)):
        assert hb.compare(a, b).data["agreement_by_sensor"] == 1
    assert hb.compare(hb.read(file), run).data["dates"] == [3, 2] and hb.compare(log, run).data["dates"] == [2, 2]


def test_windows_are_cut_by_the_clock_on_the_wall(run: hb.Run) -> None:
    days = run.windows("1d").to_pandas()
    assert days["time"].dt.strftime("%F %T").tolist() == ["2009-03-02 00:00:00", "2009-03-03 00:00:00"]
    assert set(days["hour"]) == {0.0}
    home = hb.scenario("tigerplace").data("scenario.json")
    there = hb.scenario("tigerplace").change({"scenario.json": {**home, "time_zone": "Asia/Kolkata"}})
    assert (there.run(days=1, seed=7).windows("1h").to_pandas()["hour"] % 1 == 0).all()
    # Clocks are set on at 2:00 on that day.
    spring = hb.scenario("tigerplace").run(days=3, seed=7, start="2009-03-07T00:00:00")
    begins = spring.windows("1d").to_pandas()["time"]
    assert begins.dt.hour.tolist() == [0, 0, 0] and begins.diff().dt.total_seconds().tolist()[1:] == [86_400, 82_800]
    map = spring.density()
    assert [day["recorded_h"] for day in map.data["days"]] == [24, 23, 24]
    assert map.data["hours"][2]["recorded_h"] == 2
    autumn = hb.scenario("tigerplace").run(days=1, seed=7, start="2009-11-01T00:00:00")
    assert autumn.density().data["recorded_h"] == 25 and len(autumn.windows("1d")) == 1


def test_what_is_hardly_meant_is_warned_of(tmp_path: Path) -> None:
    home = hb.scenario("tigerplace")
    late = home.with_routine("margaret", home.routine("margaret") + "\nFrom week 6, she shows depression.\n")
    with pytest.warns(UserWarning, match="it begins on day 36, and the run has 1") as told:
        run = late.run(days=1, seed=1)
    words = [str(warning.message) for warning in told]
    assert run.remarks == words == [str(remark) for remark in late.remarks(1)]
    folder = late.save(tmp_path / "late")
    command = [sys.executable, "-m", "homebody", "run", str(folder), "--for", "1d", "--seed", "1", "--out", f"csv:{tmp_path / 'a.csv'}"]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stderr
    assert all(f"]: {word}" in said for word in words) and said.count("warning[") == len(words), said
    with pytest.warns(UserWarning) as told:
        hb.cohort(late, 1, tmp_path / "cohort", days=1)
    assert [str(warning.message) for warning in told] == words
    people = [{"name": "bea", "conditions": "depression", "onset": "week 6"}]
    with pytest.warns(UserWarning, match="profiles: bea: .*begins on day 36, and the run has 1"):
        hb.cohort(home, people, tmp_path / "listed", days=1)


def test_a_log_is_walked_back(run: hb.Run, tmp_path: Path) -> None:
    short = hb.scenario("tigerplace").run(days=0.2, seed=7, into=tmp_path)
    walked = hb.translate(short, run.scenario)
    assert walked.report["mean_chance"] > 0.5 and (walked.folder / "where.csv").is_file()
    assert len(walked.movement) > 0


def test_a_scenario_is_made_and_changed_by_code(tmp_path: Path) -> None:
    home = hb.scenario("tigerplace")
    fewer = home.without_sensor(home.sensors[0])
    assert len(fewer.sensors) == len(home.sensors) - 1
    copied = hb.scenario(home.save(tmp_path / "home"))
    assert copied.run(days=0.5, seed=1).summary["sha256"] == home.run(days=0.5, seed=1).summary["sha256"]
    assert "coffee" not in home.with_routine("margaret", "# A life\nShe goes to bed at 22:00 and gets up at 6:00.\n").routine("margaret")


def test_all_that_is_wrong_comes_at_once() -> None:
    home = hb.scenario("tigerplace")
    data = home.data("home.json")
    data["sensors"][0]["room"] = data["sensors"][0]["name"] = 7
    data["sensors"][1]["kind"] = "no sensor"
    with pytest.raises(hb.ScenarioError) as told:
        home.change({"home.json": data, "scenario.json": {**home.data("scenario.json"), "time_zone": "Mars/Olympus"}})
    problems = told.value.problems
    assert {problem.file for problem in problems} >= {"home.json"} and all(problem.what for problem in problems)
    assert any(problem.line > 0 for problem in problems) and any(problem.hint for problem in problems)


def test_a_wrong_type_says_which_argument() -> None:
    home = hb.scenario("studio")
    for keys, argument in [({"days": "ten"}, "days"), ({"seed": 1.5}, "seed"), ({"without": "flu"}, "without")]:
        with pytest.raises(TypeError, match=argument):
            home.run(**keys)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="what"):
        hb.scenario(7)  # type: ignore[arg-type]


def test_other_threads_go_on_while_a_run_is_lived() -> None:
    counted = 0
    over = threading.Event()

    def count() -> None:
        nonlocal counted
        while not over.is_set():
            counted += 1
            time.sleep(0.001)

    counting = threading.Thread(target=count)
    counting.start()
    hb.scenario("tigerplace").run(days=20, seed=1)
    over.set()
    counting.join()
    assert counted > 20


def test_an_interrupt_stops_a_run_and_what_was_lived_stays(tmp_path: Path) -> None:
    code = f"""
import homebody as hb, os, signal, threading
threading.Timer(1.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    hb.scenario("tigerplace").run(days=3000, seed=1, into={str(tmp_path)!r})
except KeyboardInterrupt:
    print("interrupted")
"""
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert told.stdout == "interrupted\n", told.stderr
    (left,) = tmp_path.iterdir()
    assert len(hb.read(left).events) > 0


def test_a_run_that_is_stepped_is_the_run() -> None:
    home = hb.scenario("tigerplace")
    live, said = home.live(days=1, seed=3), 0
    while not live.done:
        said += len(live.step("7h"))
    assert said == len(home.run(days=1, seed=3).events)
    half = home.live(days=1, seed=3)
    half.step("12h")
    scene = half.scene()
    assert "margaret" in scene.bodies and half.now.endswith("12:00:00")


def test_the_command_is_in_the_package() -> None:
    told = subprocess.run([sys.executable, "-m", "homebody", "--version"], capture_output=True, text=True)
    assert told.stdout.strip() == f"homebody {hb.__version__}"
    wrong = subprocess.run([sys.executable, "-m", "homebody", "check", "nowhere"], capture_output=True, text=True)
    assert wrong.returncode == 1 and "nowhere" in wrong.stderr


@pytest.mark.parametrize(
    ("package", "code"),
    [
        ("pandas", "run.events.to_pandas()"),
        ("pyarrow", "run.events.to_pandas()"),
        ("pyarrow", "run.events.to_pyarrow()"),
        ("polars", "run.events.to_polars()"),
        ("pandas", "run.to_pyadlml()"),
        ("distributed", "hb.cohort('studio', 1, str(run.folder) + '-cohort', days=0.1, cluster='local')"),
        ("gymnasium", "import homebody.env"),
        ("numpy", "import homebody.env"),
    ],
)
def test_a_package_that_is_missing_is_named(
    run: hb.Run, monkeypatch: pytest.MonkeyPatch, package: str, code: str
) -> None:
    # What is imported already stays, but of nothing else.
    monkeypatch.delitem(sys.modules, "homebody.env", raising=False)
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(hb.MissingPackage, match=f"needs {package}, which is not installed\n  hint: pip install {package}"):
        exec(code, {"hb": hb, "run": run})  # noqa: S102


def test_a_notebook_without_tqdm_has_a_line_that_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[str] = []

    class Handle:
        def update(self, said: dict[str, str], raw: bool) -> None:
            told.append(said["text/plain"])

    shown = types.SimpleNamespace(display=lambda said, raw, display_id: Handle())
    for name, module in [("ipykernel", types.SimpleNamespace()), ("tqdm.auto", None), ("IPython.display", shown)]:
        monkeypatch.setitem(sys.modules, name, module)
    hb.scenario("studio").run(days=0.1, seed=1)
    assert told[0].startswith("simulating studio: ") and told[-1] == ""
    told.clear()
    hb.scenario("studio").run(days=0.1, seed=1, progress=False)
    assert told == []


def test_importing_it_imports_nothing_that_is_slow() -> None:
    slow = "argparse", "dask", "distributed", "gymnasium", "numpy", "pandas", "polars", "pyarrow", "tempfile", "tqdm"
    code = f"import sys, homebody; print([name for name in {slow!r} if name in sys.modules])"
    assert subprocess.check_output([sys.executable, "-c", code], text=True).strip() == "[]"
