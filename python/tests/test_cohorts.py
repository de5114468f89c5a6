"""Cohorts: the same bytes by threads, by the command, and on clusters, whatever is killed."""

from __future__ import annotations

import hashlib
import json
import os
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
    assert bytes_of(other.folder) != bytes_of(by_threads)


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
    wanted = {"residents": None, "profiles": ("people", profiles.read_text()), "days": float(DAYS), "seed": 9}
    inner = _homebody.Cohort(opened._scenario, {**wanted, "without": [], "form": "parquet"})
    inner.begin(folder)
    first = live_member(str(folder), 2)
    whole = (folder / "members" / inner.name_of(2) / "recording.json").stat().st_mtime_ns
    hb.cohort("tigerplace", profiles, folder, days=DAYS, seed=9)
    assert bytes_of(folder) == bytes_of(by_threads)
    assert (folder / "members" / inner.name_of(2) / "recording.json").stat().st_mtime_ns == whole, "it was whole"
    assert live_member(str(folder), 2) == first, "who was lived is not lived again"
    hb.cohort("tigerplace", profiles, folder, days=DAYS, seed=9)
    with pytest.raises(hb.HomebodyError, match="another cohort"):
        hb.cohort("tigerplace", profiles, folder, days=DAYS, seed=10)


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
            with pytest.raises(hb.ClusterError, match="No module named 'homebody'\n  hint: all workers have the wheel"):
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
    assert told.returncode != 0 and "in a script, what begins it stands below" in told.stderr


def test_members_go_into_other_forms(tmp_path: Path) -> None:
    lived = hb.cohort("studio", 2, tmp_path / "cohort", days=0.2, seed=1, form="csv")
    assert [path.name for path in lived.logs()] == ["log.csv", "log.csv"]
    assert len(lived.member("0002").events) > 0
    with pytest.raises(hb.ScenarioError):
        hb.cohort("studio", 2, tmp_path / "other", form="mqtt")
