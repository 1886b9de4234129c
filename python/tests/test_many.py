# SPDX-License-Identifier: MPL-2.0
"""Many structures at once."""

import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import tarfile
import threading
import time

import numpy as np
import pytest
from conftest import DATA, ROOT

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


SAS = {"kind": "sas", "voxel": 1.0}
PAIR = np.array([[0.0, 0, 0], [3, 0, 0]])


def calls(surface):
    """Leaves a line in a file for each call."""
    with open(os.environ["CALLS"], "a") as file:
        file.write("called\n")
    return {"faces": len(surface.faces)}


def sleep(surface):
    """Takes long for a large molecule."""
    if len(surface.atom_areas) > 310:
        time.sleep(60)
    return {}


def mixed(surface):
    """Numbers and texts in one column, and what no table has."""
    few = len(surface.atom_areas) < 300
    return {"mixed": 1 if few else "one", "list": [1, 2], "large": 10**400 if few else 1, "some": None if few else 2}


def test_changed_inputs_are_made_anew(tmp_path):
    pytest.importorskip("pyarrow")
    table, one, two = tmp_path / "table", tmp_path / "1.xyzr", tmp_path / "2.xyzr"
    one.write_text("0 0 0 1.5\n")
    two.write_text("0 0 0 1.6\n")
    shard = (0, [str(one), ("frame", PAIR, [1.5, 1.5])])
    first = ms.measure(shard, folder=table, **SAS)
    assert first == ms.measure(shard, folder=table, **SAS) == ms.measure(shard, **SAS)
    one.write_text("0 0 0 3\n")
    assert ms.measure(shard, folder=table, **SAS)[0]["area"] == pytest.approx(4 * np.pi * 4.4**2)
    shard = (0, [str(one), ("frame", 2 * PAIR, 2.5)])
    changed = ms.measure(shard, folder=table, **SAS)
    assert changed == ms.measure(shard, **SAS) and changed[1]["area"] != first[1]["area"]
    shard = (0, [str(two), str(one)])  # one more in the list
    assert [row["input"] for row in ms.measure(shard, folder=table, **SAS)] == shard[1]
    with pytest.raises(ValueError, match="other inputs"):
        ms.measure((0, [("none", PAIR, 1.0)]), folder=table, **SAS)
    with pytest.raises(ValueError, match="other options"):
        ms.measure(shard, folder=table, kind="vdw")


def test_files_that_options_name_count(tmp_path):
    pytest.importorskip("pyarrow")
    radii, crambin = tmp_path / "radii", str(DATA / "1crn.pdb")
    for number in (1.5, 1.7):
        radii.write_text("".join(f"* {name} {number}\n" for name in ("C", "N", "O", "S")))
        if number == 1.5:
            ms.measure((0, [crambin]), folder=tmp_path / "table", radii=str(radii), **SAS)
    with pytest.raises(ValueError, match="other options"):
        ms.measure((0, [crambin]), folder=tmp_path / "table", radii=str(radii), **SAS)


def test_what_is_the_same_is_not_made_again(folder, tmp_path, monkeypatch):
    pytest.importorskip("pyarrow")
    monkeypatch.setenv("CALLS", str(tmp_path / "calls"))
    [part] = ms.shards(folder)
    rows = ms.measure(part, calls, folder=tmp_path / "table", **SAS)
    written = (tmp_path / "table" / "part-00000000.parquet").stat().st_mtime_ns
    assert ms.measure(part, calls, folder=tmp_path / "table", **SAS) == rows
    assert (tmp_path / "table" / "part-00000000.parquet").stat().st_mtime_ns == written
    assert len((tmp_path / "calls").read_text().splitlines()) == 7
    (folder / "5.pdb").write_bytes((folder / "4.pdb").read_bytes())
    assert ms.measure(part, calls, folder=tmp_path / "table", **SAS)[5]["area"] == rows[4]["area"]
    assert len((tmp_path / "calls").read_text().splitlines()) == 8
    assert ms.measure(part, calls, folder=tmp_path / "table", kind="sas", voxel=1, select=None)[0] == rows[0]
    assert "mean" in ms.measure(part, measure_names, folder=tmp_path / "table", **SAS)[0]


@pytest.mark.parametrize("format", ["parquet", "csv"])
def test_columns_of_tables(folder, tmp_path, format):
    if format == "parquet":
        pytest.importorskip("pyarrow")
    [part] = ms.shards(folder)
    rows = ms.measure(part, measure_names, folder=tmp_path / "table", format=format, **SAS)
    assert rows == [{"mean": None, **row} for row in ms.measure(part, measure_names, **SAS)]
    assert rows == ms.measure(part, measure_names, folder=tmp_path / "table", format=format, **SAS)
    names = ["input", "error", "atoms", "kind", "area", "volume", "components", "cavities", "mean", "sha256", "options",
             "function", "version", "units"]
    path = tmp_path / "table" / f"part-00000000.{format}"
    if format == "csv":
        assert path.read_text().splitlines()[0] == ",".join(names)
    else:
        import pyarrow.parquet
        schema = pyarrow.parquet.read_schema(path)
        assert schema.names == names and schema.field("area").metadata == {b"unit": "Å²".encode()}
    assert rows[0]["sha256"] == hashlib.sha256((folder / "0.pdb").read_bytes()).hexdigest()
    assert rows[0]["version"] == ms.__version__ and "Å²" in rows[0]["units"]
    with pytest.raises(ValueError, match="parquet or csv"):
        ms.measure(part, folder=tmp_path / "table", format="xlsx", **SAS)


@pytest.mark.parametrize("format", ["parquet", "csv"])
def test_a_damaged_part_is_made_anew(folder, tmp_path, format):
    if format == "parquet":
        pytest.importorskip("pyarrow")
    [part] = ms.shards(folder)
    rows = ms.measure(part, folder=tmp_path, format=format, **SAS)
    path = tmp_path / f"part-00000000.{format}"
    whole = path.read_bytes()
    for damaged in (b"", whole[:4], whole[:len(whole) // 2], whole[:-3], b"\xff" * 100):
        path.write_bytes(damaged)
        assert ms.measure(part, folder=tmp_path, format=format, **SAS) == rows
        assert path.read_bytes() == whole


def test_columns_of_a_function_have_one_type(folder, tmp_path):
    pytest.importorskip("pyarrow")
    rows = list(ms.map(folder, mixed, workers=1, folder=tmp_path / "table", **SAS))
    assert [rows[k]["mixed"] for k in (0, 5, 6)] == ["one", None, "1"]
    assert rows[0]["list"] == "[1, 2]" and rows[0]["some"] == 2 and rows[6]["some"] is None
    assert "new columns" in ms.measure((0, [str(folder / "0.pdb")]), lambda surface: {"area": 1}, **SAS)[0]["error"]


def test_an_input_takes_no_other_with_it(folder, tmp_path):
    """It dies, needs too much memory, or takes too long."""
    pytest.importorskip("pyarrow")
    [part] = ms.shards(folder)
    good = [False] + [True] * 4 + [False, True, False]
    rows = ms.measure(part, die, folder=tmp_path / "made" / "here", **FAST)
    assert [row["error"] is None for row in rows] == good
    assert "the process ended" in rows[0]["error"] and rows[1]["area"] == ms.read(folder / "1.pdb").surface(**FAST).area
    rows = ms.measure(part, sleep, max_hours=2 / 3600, **FAST)
    assert [row["error"] is None for row in rows] == good and "TimeoutError" in rows[7]["error"]
    items = [("large", 100 * PAIR, 60.0), ("small", PAIR, 1.5)]
    for rows in (ms.measure((0, items), memory="300M", kind="ses", voxel=0.25),
                 list(ms.map(items, memory="300M", workers=1, kind="ses", voxel=0.25))):
        assert re.match("InputError, may pass: .* of memory", rows[0]["error"]) and rows[1]["error"] is None
    for wrong in ({"memory": "much"}, {"memory": 0}, {"max_hours": 0}, {"max_hours": "1"}):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            ms.measure(part, **wrong)


def test_one_part_by_two_workers_at_once(folder, tmp_path, monkeypatch):
    """Even if their processes have one number, as in two containers."""
    parquet = pytest.importorskip("pyarrow.parquet")
    write, both = parquet.write_table, threading.Barrier(2, timeout=60)

    def write_slowly(table, path):
        write(table, path)
        both.wait()
    monkeypatch.setattr(parquet, "write_table", write_slowly)
    found = []
    workers = [threading.Thread(target=lambda: found.append(ms.measure((0, [str(folder / "0.pdb")]), folder=tmp_path / "t",
                                                                       **SAS))) for _ in range(2)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert len(found) == 2 and found[0] == found[1] and os.listdir(tmp_path / "t") == ["part-00000000.parquet"]


def test_parts_of_an_earlier_size_are_removed(folder, tmp_path):
    for size, parts in ((3, 3), (8, 1)):
        rows = list(ms.map(folder, workers=1, size=size, folder=tmp_path / "t", format="csv", **SAS))
        assert len(rows) == 8 and len(os.listdir(tmp_path / "t")) == parts


def test_what_killed_processes_left_is_removed(folder, tmp_path):
    list(ms.map(folder, workers=1, folder=tmp_path / "t", format="csv", **SAS))
    left = tmp_path / "t" / ".part-00000000.csv.host.0123"
    left.touch()
    os.utime(left, (1, 1))
    list(ms.map(folder, workers=1, folder=tmp_path / "t", format="csv", **SAS))
    assert os.listdir(tmp_path / "t") == ["part-00000000.csv"]


def test_an_archive_is_searched_once(folder, monkeypatch):
    with tarfile.open(folder / "all.tar.gz", "w:gz") as archive:
        for k in range(5):
            archive.add(folder / f"{k}.pdb", f"{k}.pdb")
    parts, opened, open_ = list(ms.shards(folder / "all.tar.gz", 2)), [], tarfile.open
    monkeypatch.setattr(tarfile, "open", lambda *words: opened.append(words) or open_(*words))
    rows = [row for part in parts for row in ms.measure(part, **FAST)]
    assert len(opened) == 1
    assert [row["area"] for row in rows] == [ms.read(folder / f"{k}.pdb").surface(**FAST).area for k in range(5)]
    [row] = ms.measure((0, [f"{folder}/all.tar.gz::none.pdb"]), **FAST)
    assert "FileNotFoundError" in row["error"]


def test_dask(folder, tmp_path):
    distributed = pytest.importorskip("distributed")
    pytest.importorskip("pyarrow")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, \
            distributed.Client(cluster) as client:
        parts = client.map(ms.measure, list(ms.shards(folder, 3)), folder=str(tmp_path / "new"), **FAST)
        rows = [row for part in client.gather(parts) for row in part]
        parts = client.map(ms.measure, list(ms.shards(folder, 3)), function=die, **FAST)
        ended = [row["error"] is None for part in client.gather(parts) for row in part]
    [part] = ms.shards(folder)
    assert rows == ms.measure(part, **FAST)
    assert ended == [False] + [True] * 4 + [False, True, False]


def test_the_table_of_snakemake(folder):
    """It is made anew if keywords or inputs have changed, without pyarrow as well."""
    pytest.importorskip("snakemake")

    def table(probe):
        subprocess.run([sys.executable, "-m", "snakemake", "-s", ROOT / "scripts" / "workflow" / "table" / "Snakefile",
                        "--cores", "2", "--config", f"structures={folder}", "size=4", "format=csv",
                        f'surface={{"kind": "sas", "voxel": 2.0, "probe": {probe}}}'], cwd=folder, check=True)
        parts = sorted((folder / "table").iterdir())
        return [path.read_text() for path in parts], [path.stat().st_mtime_ns for path in parts]
    first, written = table(1.4)
    assert [len(part.splitlines()) for part in first] == [5, 5] and table(1.4) == (first, written)
    (folder / "0.pdb").write_bytes((folder / "1.pdb").read_bytes())
    changed, again = table(1.4)
    assert changed[0] != first[0] and changed[1] == first[1] and again[1] == written[1]
    (folder / "0.pdb").unlink()
    for name in ("1.pdb", "2.pdb", "3.pdb", "4.pdb"):
        (folder / name).unlink()
    [last], _ = table(1.5)
    assert len(last.splitlines()) == 4
