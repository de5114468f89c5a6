"""Cohorts: the same bytes by threads, by the command, and on clusters, whatever is killed."""

from __future__ import annotations

import hashlib
import inspect
import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import homebody as hb
import polars
import pytest
from homebody import _homebody
from homebody.cluster import live_member

PEOPLE = {
    "age": {"normal": [82, 6], "least": 65, "most": 99, "digits": 0},
    "pace_mps": {"normal": [0.8, 0.15], "least": 0.4, "most": 1.3},
    "conditions": {"none": 3, "depression": 1},
    "severity": {"mild": 1, "moderate": 1},
    "onset": {"day 1": 1},
}
#: Members and days: enough that a worker is killed while others are still to come.
COUNT, DAYS = 6, 2


def bytes_of(folder: Path) -> dict[str, str]:
    """Digests of all files that stay, by their paths."""
    files = (path for path in sorted(folder.rglob("*")) if path.is_file())
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


@pytest.fixture(scope="module")
def profiles(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from homebody.profiles import table

    path = tmp_path_factory.mktemp("profiles") / "people.csv"
    path.write_text(table(hb.draw(PEOPLE, COUNT, seed=5)))
    return path


@pytest.fixture(scope="module")
def by_threads(profiles: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("threads") / "cohort"
    hb.cohort("tigerplace", profiles, folder, days=DAYS, seed=9)
    return folder


def test_the_command_leaves_the_same_bytes(profiles: Path, by_threads: Path, tmp_path: Path) -> None:
    words = ["run", str(hb.scenario("tigerplace").save(tmp_path / "home")), "--profiles", str(profiles), "--quiet"]
    words += ["--for", f"{DAYS}d", "--seed", "9", "--out", f"parquet:{tmp_path / 'cohort'}"]
    subprocess.run([sys.executable, "-m", "homebody", *words], check=True)
    assert bytes_of(tmp_path / "cohort") == bytes_of(by_threads)
    other = hb.cohort("tigerplace", profiles, tmp_path / "other", days=DAYS, seed=10)
    assert bytes_of(Path(other.folder)) != bytes_of(by_threads)


def test_the_program_has_each_option_of_a_run_that_the_function_has() -> None:
    words = [sys.executable, "-m", "homebody.cohort", "--help"]
    shown = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    options = [name for name in json.loads(_homebody.RUN_OPTIONS) if name in inspect.signature(hb.cohort).parameters]
    assert {"days", "seed", "without"} <= set(options)
    values = {"without": "CONDITION"}
    assert all(f"--{name.replace('_', '-')} {values.get(name, name.upper())}" in shown for name in options)
    # The days and the seed.
    assert " ".join(shown.split()).count("(default: that of the scenario)") == 2
    assert "--numbers" not in shown


@pytest.mark.parametrize("workers", [1, 2, 4])
def test_a_cluster_leaves_the_same_bytes(profiles: Path, by_threads: Path, tmp_path: Path, workers: int) -> None:
    folder = tmp_path / "cohort"
    words = ["tigerplace", "--profiles", str(profiles), "--days", str(DAYS), "--seed", "9", "--out", str(folder)]
    words += ["--cluster", "local", "--workers", str(workers)]
    subprocess.run([sys.executable, "-m", "homebody.cohort", *words], check=True, timeout=300)
    assert bytes_of(folder) == bytes_of(by_threads)


def test_a_worker_that_is_killed_loses_nothing_and_doubles_nothing(
    profiles: Path, by_threads: Path, tmp_path: Path
) -> None:
    from distributed import Client, LocalCluster

    folder = tmp_path / "cohort"
    local = LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None)
    with local, Client(local) as client:
        code = f"""
import homebody as hb
hb.cohort("tigerplace", {str(profiles)!r}, {str(folder)!r}, days={DAYS}, seed=9, cluster={client.scheduler.address!r})
"""
        living = subprocess.Popen([sys.executable, "-c", code])
        begun = folder / "members"
        while not (begun.is_dir() and len(list(begun.iterdir())) >= 2):
            assert living.poll() is None
            time.sleep(0.01)
        killed = next(iter(local.workers.values())).pid
        os.kill(killed, signal.SIGKILL)
        assert living.wait(timeout=300) == 0
    assert bytes_of(folder) == bytes_of(by_threads)


def test_a_cohort_that_was_stopped_goes_on(profiles: Path, by_threads: Path, tmp_path: Path) -> None:
    folder = tmp_path / "cohort"
    opened = hb.scenario("tigerplace")
    request = {"residents": None, "profiles": ("people", profiles.read_text()), "form": "parquet", "truth": None}
    inner = _homebody.Cohort(opened._scenario, json.dumps({"days": DAYS, "seed": 9}), request)
    inner.create(folder)
    first = live_member(str(folder), 2)
    whole = (folder / "members" / inner.name_of(2) / "recording.json").stat().st_mtime_ns
    hb.cohort("tigerplace", profiles, folder, days=DAYS, seed=9)
    assert bytes_of(folder) == bytes_of(by_threads)
    assert (folder / "members" / inner.name_of(2) / "recording.json").stat().st_mtime_ns == whole, "it was whole"
    assert live_member(str(folder), 2) == first, "who was lived is not lived again"
    hb.cohort("tigerplace", profiles, folder, days=DAYS, seed=9)
    with pytest.raises(hb.HomebodyError, match="another cohort"):
        hb.cohort("tigerplace", profiles, folder, days=DAYS, seed=10)


def test_an_interrupt_stops_a_cohort_at_once_and_the_same_call_goes_on(tmp_path: Path) -> None:
    members, folder = 80, tmp_path / "cohort"
    code = f"""
import os, signal, threading, time
from pathlib import Path
import homebody as hb

def interrupt():
    while not list(Path({str(folder)!r}).glob("log/member=*/log.parquet")):
        time.sleep(0.001)
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=interrupt).start()
try:
    hb.cohort("studio", {members}, {str(folder)!r}, days=8, seed=1)
except KeyboardInterrupt:
    print("interrupted")
"""
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300)
    assert told.stdout == "interrupted\n", told.stderr
    # Who was stopped has a log, too, and a recording that says so.
    told_of = {path: json.loads(path.read_text()) for path in folder.glob("members/*/recording.json")}
    names = [path.parent.name for path, run in told_of.items() if run["sha256"] and "stopped_of_us" not in run]
    assert 0 < len(names) < members / 2
    whole = folder / "log" / f"member={names[0]}" / "log.parquet"
    kept = whole.stat().st_mtime_ns
    hb.cohort("studio", members, folder, days=8, seed=1)
    hb.cohort("studio", members, tmp_path / "other", days=8, seed=1)
    assert bytes_of(folder) == bytes_of(tmp_path / "other")
    assert whole.stat().st_mtime_ns == kept, "who was lived is not lived again"


def test_a_scheduler_that_dies_is_told(tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": str(Path(hb.__file__).parents[1])}
    folder, known = tmp_path / "cohort", tmp_path / "scheduler.json"
    begin = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
    quiet = {"env": environment, "cwd": tmp_path, "stderr": subprocess.DEVNULL}
    scheduler = subprocess.Popen([*begin, "--scheduler-file", str(known)], **quiet)  # type: ignore[call-overload]
    begin = [sys.executable, "-m", "distributed.cli.dask_worker", "--no-dashboard", "--no-nanny", "--nthreads", "1"]
    worker = subprocess.Popen([*begin, "--scheduler-file", str(known)], **quiet)  # type: ignore[call-overload]

    def kill() -> None:
        # The cohort is under way by then.
        while not list(folder.glob("log/member=*/log.parquet")):
            time.sleep(0.01)
        scheduler.kill()

    late = threading.Thread(target=kill)
    try:
        while not known.is_file():
            assert scheduler.poll() is None
            time.sleep(0.01)
        late.start()
        address = json.loads(known.read_text())["address"]
        with pytest.raises(hb.ClusterError, match="(?s)lost its tasks.*\n  hint: completed members are kept; .* repeat the call to resume"):
            hb.cohort("studio", 200, folder, days=5, seed=1, cluster=address)
    finally:
        for one in (scheduler, worker):
            one.kill()
            one.wait()
    assert list(folder.glob("log/member=*/log.parquet"))


def test_the_manifest_says_what_was_asked_and_has_digests(by_threads: Path) -> None:
    lived = hb.Cohort(by_threads)
    manifest = lived.manifest
    assert manifest["seed"] == 9 and manifest["recording"]["version"] == hb.__version__
    assert "profiles" in manifest["asked"] and len({member["sha256"] for member in manifest["members"]}) == COUNT
    assert json.dumps(manifest).count('"profile"') == COUNT


def test_the_set_is_read_as_one_and_truth_is_apart(by_threads: Path) -> None:
    lived = hb.Cohort(by_threads)
    logs = polars.scan_parquet(by_threads / "log", hive_partitioning=True).collect()
    assert logs["member"].n_unique() == COUNT
    assert len(logs) == sum(member["rows"] for member in lived.manifest["members"])
    assert not any("truth" in path.name for path in (by_threads / "log").rglob("*"))
    assert len(lived.truths("activity")) == COUNT
    log = lived.member(lived.members[0])
    assert len(log.events) == lived.manifest["members"][0]["rows"]
    assert log.time_zone == "America/Chicago" and len(log.activities) > 10
    assert log.labelled().columns[-5:] == ["resident", "room", "activity", "cause", "thing"]


def test_wrong_rows_are_all_named(tmp_path: Path) -> None:
    rows = [{"name": "anna", "age": "old"}, {"name": "anna"}, {"name": "bea", "conditions": "hiccups"}]
    with pytest.raises(hb.ScenarioError) as told:
        hb.cohort("tigerplace", rows, tmp_path / "cohort")
    assert {problem.line for problem in told.value.problems} == {2, 3, 4}
    with pytest.raises(hb.ScenarioError) as told:
        hb.draw({"age": {"normal": [1]}, "shoes": {}, "conditions": {"none": -1}}, 3)
    assert len(told.value.problems) >= 3


def test_what_is_drawn_hangs_on_seed_name_and_column_alone() -> None:
    drawn = hb.draw(PEOPLE, 50, seed=5)
    assert [row["pace_mps"] for row in hb.draw({"pace_mps": PEOPLE["pace_mps"]}, 60, seed=5)][:50] == [
        row["pace_mps"] for row in drawn
    ]
    assert drawn != hb.draw(PEOPLE, 50, seed=6)
    assert all(0.4 <= float(row["pace_mps"]) <= 1.3 for row in drawn)


def test_a_cluster_that_is_not_there_and_a_folder_that_is_not_are_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("homebody.cluster.TIMEOUT_S", 1)
    with pytest.raises(hb.ClusterError, match="no cluster answers"):
        hb.cohort("studio", 1, tmp_path / "a", days=0.1, cluster="tcp://127.0.0.1:1")
    with pytest.raises(hb.ClusterError, match="does not see"):
        live_member(str(tmp_path / "nowhere"), 0)
    bucket = "s3://bucket/cohort"
    with pytest.raises(hb.LogError, match="without object stores\n  hint: build Homebody with --features cloud|does not"):
        hb.cohort("studio", 1, bucket, days=0.1)
    with pytest.raises(ValueError, match="cluster"):
        hb.cohort("studio", 1, tmp_path / "b", days=0.1, cluster="nearby")


def test_a_cluster_without_workers_is_told_and_so_are_workers_without_the_package(tmp_path: Path) -> None:
    from distributed import Client, LocalCluster

    bare = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    begun: list[subprocess.Popen[bytes]] = []
    with LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address=None) as local:
        words = [sys.executable, "-m", "distributed.cli.dask_worker", local.scheduler_address, "--no-dashboard", "--no-nanny"]

        def begin(environment: dict[str, str]) -> None:
            begun.append(subprocess.Popen(words, env=environment, cwd=tmp_path, stderr=subprocess.DEVNULL))

        try:
            late = threading.Timer(1, begin, [{**bare, "PYTHONPATH": str(Path(hb.__file__).parents[1])}])
            late.start()
            with pytest.warns(UserWarning, match="no workers yet"):
                hb.cohort("studio", 1, tmp_path / "a", days=0.1, cluster=local.scheduler_address)
            if subprocess.run([sys.executable, "-c", "import homebody"], env=bare, cwd=tmp_path, capture_output=True).returncode == 0:
                pytest.skip("the package is installed here, and not only beside its tests")
            begin(bare)
            with Client(local) as client:
                client.wait_for_workers(2, timeout=60)
            with pytest.raises(hb.ClusterError, match="No module named 'homebody'\n  hint: install the wheel"):
                hb.cohort("studio", 1, tmp_path / "b", days=0.1, cluster=local.scheduler_address)
        finally:
            late.join()
            for worker in begun:
                worker.kill()
                worker.wait()


def test_a_script_that_begins_a_local_cluster_as_it_is_imported_is_told_how(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(f"import homebody as hb\nhb.cohort('studio', 1, {str(tmp_path / 'a')!r}, days=0.1, cluster='local', workers=1)\n")
    told = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, timeout=120)
    assert told.returncode != 0 and "in a script, put the call below" in told.stderr


def test_a_cohort_begins_where_nothing_is(tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(hb.Exists, match="already contains mine.txt\n  hint: name a new or an empty folder"):
        hb.cohort("studio", 1, tmp_path, days=0.1)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_homes_are_mixed_and_each_members_is_told(tmp_path: Path) -> None:
    other = hb.scenario("older-adult").data("home.json")
    # A home that no scenario links is another file of it.
    home = hb.scenario("studio").change({"other.json": other})
    people = hb.draw({"home": {"home.json": 1, "other.json": 1}, "pace_mps": {"uniform": [0.5, 0.9]}}, 6, seed=2)
    lived = hb.cohort(home, people, tmp_path / "cohort", days=0.5, seed=3)
    homes = {member["name"]: member["profile"]["home"] for member in lived.manifest["members"]}
    assert set(homes.values()) == {"home.json", "other.json"} and homes == {row["name"]: row["home"] for row in people}
    told = {"home.json": "Studio", "other.json": other["name"]}
    for name, file in homes.items():
        log = lived.member(name)
        row = log.truth("home").to_pandas().iloc[0]
        assert (row["file"], row["name"]) == (file, told[file])
        assert ("bed motion" in log.sensors) == (file == "home.json")
    # Who is missing is lived again where they lived.
    before = bytes_of(tmp_path / "cohort")
    for missing in ("log/member=0001", "truth/member=0001", "members/0001"):
        shutil.rmtree(tmp_path / "cohort" / missing)
    hb.cohort(home, people, tmp_path / "cohort", days=0.5, seed=3)
    assert bytes_of(tmp_path / "cohort") == before


def test_of_a_brief_truth_what_has_few_rows_is_kept(tmp_path: Path) -> None:
    whole = hb.cohort("studio", 2, tmp_path / "whole", days=1, seed=1)
    brief = hb.cohort("studio", 2, tmp_path / "brief", days=1, seed=1, truth="brief")
    gone = {"cause", "off", "movement", "lost"}
    tables = [{path.name.split(".")[1] for path in (of / "truth" / "member=0001").iterdir()} for of in (tmp_path / "whole", tmp_path / "brief")]
    assert tables[0] - tables[1] == gone and tables[1] < tables[0]
    one, other = whole.member("0001"), brief.member("0001")
    assert other.activities.to_pandas().equals(one.activities.to_pandas()) and len(other.rooms) == len(one.rooms) > 10
    for read in (other.labelled, lambda: other.truth("movement")):
        with pytest.raises(hb.LogError, match="has no table .*\n  hint: replay the recording"):
            read()
    # A cohort of very many days keeps what is brief, unless all is asked for.
    request = {"residents": 40, "profiles": None, "form": "parquet", "truth": None}
    for truth, kept in ((None, "brief"), ("all", None)):
        folder = tmp_path / f"large-{truth}"
        _homebody.Cohort(hb.scenario("studio")._scenario, '{"days": 365, "seed": 1}', {**request, "truth": truth}).create(folder)
        assert json.loads((folder / "cohort.json").read_text()).get("truth") == kept


def test_more_members_than_there_may_be_are_refused_on_both_sides() -> None:
    from homebody.profiles import MOST

    request = {"profiles": None, "form": "parquet", "truth": None}
    for count in (0, MOST + 1):
        with pytest.raises(ValueError, match=f"profiles is {count}"):
            hb.cohort("studio", count, "never")
        with pytest.raises(hb.ScenarioError, match=f"a cohort cannot have {count} members"):
            _homebody.Cohort(hb.scenario("studio")._scenario, '{"days": 1}', {**request, "residents": count})


#: What a worker's files may be at most, in bytes: less than a log has.
SMALL = 4_000


@pytest.mark.skipif(sys.platform == "win32", reason="files of processes are not limited there")
def test_a_worker_without_space_is_told_and_the_cohort_goes_on_once_there_is_some(
    profiles: Path, by_threads: Path, tmp_path: Path
) -> None:
    import resource

    from distributed import LocalCluster

    folder = tmp_path / "cohort"

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (SMALL, SMALL))

    with LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address=None) as local:
        words = [sys.executable, "-m", "distributed.cli.dask_worker", local.scheduler_address, "--no-dashboard", "--no-nanny"]
        environment = {**os.environ, "PYTHONPATH": str(Path(hb.__file__).parents[1])}
        worker = subprocess.Popen(words, env=environment, cwd=tmp_path, stderr=subprocess.DEVNULL, preexec_fn=limit)
        try:
            # Which member is refused first is up to the scheduler.
            with pytest.raises(hb.LogError, match=r"members/\d{4}/.*(space|large|written)"):
                hb.cohort("tigerplace", profiles, folder, days=DAYS, seed=9, cluster=local.scheduler_address)
        finally:
            worker.kill()
            worker.wait()
    assert not list(folder.rglob("log.parquet")), "nothing half written has its name"
    hb.cohort("tigerplace", profiles, folder, days=DAYS, seed=9)
    assert bytes_of(folder) == bytes_of(by_threads)


#: A worker that has lived members for so long has all the memory that it needs.
WARM, MANY = 20, 120


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory is read where Linux tells it")
def test_the_memory_of_a_worker_is_bounded(tmp_path: Path) -> None:
    code = f"""
import re, sys
from pathlib import Path
import homebody as hb
from homebody import _homebody
from homebody.cluster import live_member

def resident_kb():
    return int(re.search(r"VmRSS:\\s+(\\d+)", Path("/proc/self/status").read_text())[1])

folder = {str(tmp_path / "cohort")!r}
request = {{"residents": {MANY}, "profiles": None, "form": "parquet", "truth": None}}
_homebody.Cohort(hb.scenario("studio")._scenario, '{{"days": 0.5, "seed": 1}}', request).create(folder)
for index in range({MANY}):
    if index == {WARM}:
        warm = resident_kb()
    live_member(folder, index)
print(warm, resident_kb())
"""
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=300)
    warm, at_last = map(int, told.stdout.split())
    # A member's files are 40 kB: kept, a hundred of them would be seen.
    assert at_last < warm + 6_000, f"{warm} kB after {WARM} members, {at_last} kB after {MANY}"


def test_a_worker_without_the_package_that_joins_late_is_left_out(tmp_path: Path) -> None:
    from distributed import LocalCluster

    bare = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    if subprocess.run([sys.executable, "-c", "import homebody"], env=bare, cwd=tmp_path, capture_output=True).returncode == 0:
        pytest.skip("the package is installed here, and not only beside its tests")
    with LocalCluster(n_workers=1, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as local:
        words = [sys.executable, "-m", "distributed.cli.dask_worker", local.scheduler_address, "--no-dashboard", "--no-nanny"]
        worker: list[subprocess.Popen[bytes]] = []

        def join() -> None:
            # The cohort is under way by then.
            while not (tmp_path / "cohort" / "members").is_dir():
                time.sleep(0.01)
            worker.append(subprocess.Popen(words, env=bare, cwd=tmp_path, stderr=subprocess.DEVNULL))

        late = threading.Thread(target=join)
        late.start()
        try:
            with pytest.warns(UserWarning, match="is left out: .* lacks the package: No module named 'homebody'"):
                lived = hb.cohort("tigerplace", 40, tmp_path / "cohort", days=3, seed=1, cluster=local.scheduler_address)
        finally:
            late.join()
            for one in worker:
                one.kill()
                one.wait()
    assert len(lived) == 40


def test_members_go_into_other_forms(tmp_path: Path) -> None:
    lived = hb.cohort("studio", 2, tmp_path / "cohort", days=0.2, seed=1, form="csv")
    assert [Path(path).name for path in lived.logs()] == ["log.csv", "log.csv"]
    assert all(Path(path).is_file() for path in lived.logs() + lived.truths("room"))
    assert len(lived.member("0002").events) > 0
    with pytest.raises(hb.ScenarioError):
        hb.cohort("studio", 2, tmp_path / "other", form="mqtt")
