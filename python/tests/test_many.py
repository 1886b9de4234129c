# SPDX-License-Identifier: MPL-2.0
"""Many structures at once."""

import os
import shutil
import signal
import subprocess
import sys
import tarfile
import time

import numpy as np
import pytest
from conftest import DATA

import vdb_molsurf as ms

FAST = {"kind": "ses", "voxel": 1.5}


@pytest.fixture
def folder(tmp_path):
    """Eight structures, one of which is none."""
    text = (DATA / "1crn.pdb").read_text().splitlines(keepends=True)
    atoms = [i for i, line in enumerate(text) if line.startswith("ATOM")]
    for k in range(7):
        kept = set(atoms[:len(atoms) - 20 * k])
        (tmp_path / f"{k}.pdb").write_text("".join(line for i, line in enumerate(text)
                                                   if i not in atoms or i in kept))
    (tmp_path / "5.pdb").write_text("ATOM  nothing\n")
    (tmp_path / "readme.txt").write_text("not a structure\n")
    (tmp_path / "large.pdb").write_text("".join(text))
    return tmp_path


def measure_names(surface):
    """A function of a module, as workers need it."""
    return {"mean": float(np.mean(surface.curvature))}


def die(surface):
    """Ends the process of a large molecule."""
    if len(surface.atom_areas) > 310:
        os.kill(os.getpid(), signal.SIGKILL)
    return {}


def test_shards():
    items = [(str(k), np.zeros((1, 3)), [1.5]) for k in range(7)]
    parts = list(ms.shards(iter(items), 3))
    assert [part.number for part in parts] == [0, 1, 2]
    assert [len(part.items) for part in parts] == [3, 3, 1]
    assert [item[0] for part in parts for item in part.items] == [str(k) for k in range(7)]
    with pytest.raises(ValueError, match="size"):
        list(ms.shards(items, 0))
    with pytest.raises(TypeError, match="sources"):
        list(ms.shards(3.5))


def test_sources(folder):
    names = [f"{k}.pdb" for k in range(7)] + ["large.pdb"]
    [part] = ms.shards(folder)
    assert part.items == [str(folder / name) for name in names]
    with tarfile.open(folder / "all.tar", "w") as archive:
        for name in names[:2]:
            archive.add(folder / name, name)
    [part] = ms.shards(folder / "all.tar")
    assert part.items == [f"{folder / 'all.tar'}::{name}" for name in names[:2]]
    packed, plain = ms.measure(part, **FAST), ms.measure((0, [str(folder / name) for name in names[:2]]), **FAST)
    assert [row["area"] for row in packed] == [row["area"] for row in plain]


def test_a_folder_has_every_format_that_is_read(tmp_path):
    names = [f"a{ending}{packed}" for ending in (".bcif", ".cif", ".gro", ".mol2", ".pdb", ".sdf", ".xyzrn")
             for packed in ("", ".gz")]
    for name in [*names, "a.ply", "a.txt"]:
        (tmp_path / name).touch()
    [part] = ms.shards(tmp_path)
    assert part.items == [str(tmp_path / name) for name in sorted(names)]


def test_rows(folder):
    [part] = ms.shards(folder)
    rows = ms.measure(part, measure_names, **FAST)
    assert [row["error"] is None for row in rows] == [True] * 5 + [False] + [True] * 2
    assert rows[5]["area"] is None and "5.pdb" in rows[5]["input"] and "InputError" in rows[5]["error"]
    alone = ms.read(folder / "2.pdb").surface(**FAST)
    assert rows[2]["area"] == alone.area and rows[2]["volume"] == alone.volume
    assert rows[2]["atoms"] == 287 and rows[2]["kind"] == "ses" and rows[2]["components"] == 1
    assert rows[2]["mean"] == pytest.approx(float(np.mean(alone.curvature)))
    with pytest.raises(TypeError, match="did you mean voxel"):
        ms.measure(part, voxell=1)


def test_frames():
    positions = np.array([[0.0, 0, 0], [2.8, 0, 0]])
    frames = ((f"frame {k}", positions * (1 + 0.1 * k), [1.7, 1.5]) for k in range(3))
    rows = list(ms.map(frames, workers=1, size=2, kind="vdw", voxel=0.5))
    assert [row["input"] for row in rows] == ["frame 0", "frame 1", "frame 2"]
    assert rows[2]["area"] == pytest.approx(4 * np.pi * (1.7**2 + 1.5**2))
    assert rows[0]["area"] < rows[1]["area"] < rows[2]["area"]


def test_workers(folder):
    [part] = ms.shards(folder)
    assert list(ms.map(folder, measure_names, workers=2, size=3, **FAST)) == ms.measure(part, measure_names, **FAST)


def test_a_process_that_dies(folder):
    rows = list(ms.map(folder, die, workers=2, size=4, **FAST))
    assert [row["error"] is None for row in rows] == [False] + [True] * 4 + [False] * 1 + [True, False]
    assert "the process ended" in rows[0]["error"] and "the process ended" in rows[7]["error"]
    assert rows[1]["area"] == ms.read(folder / "1.pdb").surface(**FAST).area


def test_an_end_and_a_second_beginning(folder, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    script = tmp_path / "run.py"
    script.write_text("import sys, vdb_molsurf as ms\n"
                      "if __name__ == '__main__':\n"
                      "    print(len(list(ms.map(sys.argv[1], workers=1, size=1, folder=sys.argv[2], kind='ses', voxel=1.5))))\n")
    ended, whole = tmp_path / "ended", tmp_path / "whole"
    run = subprocess.Popen([sys.executable, script, folder, ended])
    until = time.monotonic() + 60
    while not (ended / "part-00000001.parquet").exists():
        assert time.monotonic() < until and run.poll() is None
        time.sleep(0.01)
    run.kill()
    run.wait()
    assert len(list(ended.glob("*.parquet"))) < 8
    first = (ended / "part-00000000.parquet").stat().st_mtime_ns
    for where in (ended, whole):
        assert int(subprocess.run([sys.executable, script, folder, where], check=True, capture_output=True).stdout) == 8
    assert (ended / "part-00000000.parquet").stat().st_mtime_ns == first
    assert parquet.read_table(ended).equals(parquet.read_table(whole))
    assert sorted(os.listdir(ended)) == sorted(os.listdir(whole))
    table = parquet.read_table(whole)
    assert table.column("error").null_count == 7 and table.num_rows == 8
    with pytest.raises(ValueError, match="other options"):
        list(ms.map(folder, workers=1, size=1, folder=ended, kind="vdw", voxel=1.5))
    shutil.rmtree(ended)


def test_dask(folder):
    distributed = pytest.importorskip("distributed")
    pytest.importorskip("pyarrow")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, \
            distributed.Client(cluster) as client:
        parts = client.map(ms.measure, list(ms.shards(folder, 3)), folder=str(folder), **FAST)
        rows = [row for part in client.gather(parts) for row in part]
    [part] = ms.shards(folder)
    assert rows == ms.measure(part, **FAST)
