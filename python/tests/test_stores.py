"""Cohorts in an object store, where the library knows one, with the server of moto."""

from __future__ import annotations

import hashlib
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import homebody as hb
import pytest

COUNT, DAYS = 12, 2


@pytest.fixture
def bucket(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """The address of a bucket."""
    program = os.environ.get("HOMEBODY_MOTO") or shutil.which("moto_server")
    if program is None:
        pytest.skip("there is no moto_server, as pip install 'moto[server]' brings it")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    at = f"http://127.0.0.1:{port}"
    for name, value in {"ENDPOINT": at, "REGION": "us-east-1", "ACCESS_KEY_ID": "ann", "SECRET_ACCESS_KEY": "secret"}.items():
        monkeypatch.setenv(f"AWS_{name}", value)
    silent = subprocess.DEVNULL
    server = subprocess.Popen([program, "-H", "127.0.0.1", "-p", str(port)], stdout=silent, stderr=silent)
    try:
        for _ in range(600):
            try:
                urllib.request.urlopen(urllib.request.Request(f"{at}/bucket", method="PUT")).close()
                break
            except OSError:
                time.sleep(0.1)
        try:
            hb.Cohort("s3://bucket/nowhere")
        except hb.HomebodyError as error:
            if error.code == "destination::no-object-store":
                pytest.skip("this library knows no object store: it was built without the feature cloud")
        yield f"{at}/bucket"
    finally:
        server.kill()
        server.wait()


def names(bucket: str, below: str) -> list[str]:
    with urllib.request.urlopen(f"{bucket}?list-type=2&prefix={below}") as told:
        text = told.read().decode()
    return [part.split("</Key>")[0] for part in text.split("<Key>")[1:]]


def bytes_of(bucket: str, below: str) -> dict[str, str]:
    """Digests of all files, by their paths."""
    digests = {}
    for name in names(bucket, below):
        # Somebody has to have signed; this server does not look at what.
        asked = urllib.request.Request(f"{bucket}/{name}", headers={"Authorization": "AWS ann:signed"})
        with urllib.request.urlopen(asked) as told:
            digests[name.removeprefix(below)] = hashlib.sha256(told.read()).hexdigest()
    return digests


@pytest.fixture
def by_threads(tmp_path: Path) -> dict[str, str]:
    folder = tmp_path / "threads"
    hb.cohort("tigerplace", COUNT, folder, days=DAYS, seed=9)
    files = [path for path in folder.rglob("*") if path.is_file()]
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


def test_a_cohort_in_a_store_has_the_same_bytes_by_threads_and_on_a_cluster(
    bucket: str, by_threads: dict[str, str], tmp_path: Path
) -> None:
    lived = hb.cohort("tigerplace", COUNT, "s3://bucket/threads/", days=DAYS, seed=9)
    assert bytes_of(bucket, "threads/") == by_threads
    words = ["tigerplace", "--residents", str(COUNT), "--days", str(DAYS), "--seed", "9", "--out", "s3://bucket/cluster"]
    words += ["--cluster", "local", "--workers", "2"]
    subprocess.run([sys.executable, "-m", "homebody.cohort", *words], check=True, timeout=300)
    assert bytes_of(bucket, "cluster/") == by_threads
    # What is there is read where it is, or brought here.
    assert lived.logs()[0] == "s3://bucket/threads/log/member=0001/log.parquet"
    member = lived.member("0002")
    assert len(member.events) == lived.manifest["members"][1]["rows"] and len(member.activities) > 10
    assert len(hb.read("parquet:s3://bucket/threads/log/member=0002").events) == len(member.events)
    with pytest.raises(hb.HomebodyError, match="another cohort"):
        hb.cohort("tigerplace", COUNT, "s3://bucket/threads", days=DAYS, seed=10)


def test_a_cohort_in_a_store_whose_worker_and_whose_program_are_killed_goes_on(
    bucket: str, by_threads: dict[str, str]
) -> None:
    from distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as local:
        code = f"""
import homebody as hb
hb.cohort("tigerplace", {COUNT}, "s3://bucket/killed", days={DAYS}, seed=9, cluster={local.scheduler_address!r})
"""
        living = subprocess.Popen([sys.executable, "-c", code])
        while len(names(bucket, "killed/members/")) < 2:
            assert living.poll() is None
            time.sleep(0.01)
        os.kill(next(iter(local.workers.values())).pid, signal.SIGKILL)
        living.kill()
        living.wait()
        before = names(bucket, "killed/")
        assert len(before) < len(by_threads)
        # The same call resumes it.
        again = subprocess.run([sys.executable, "-c", code], timeout=300)
        assert again.returncode == 0
    assert bytes_of(bucket, "killed/") == by_threads
