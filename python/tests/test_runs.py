# SPDX-License-Identifier: MPL-2.0
"""Progress, Ctrl-C, threads, processes and pickles."""

import multiprocessing
import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import vdb_molsurf as ms
from conftest import DATA


def big(copies=12):
    """A molecule that takes seconds."""
    m = ms.read(DATA / "4at1.ent.gz")
    step = np.arange(copies) * 150.0
    return (m.positions[None] + np.c_[step, 0 * step, 0 * step][:, None]).reshape(-1, 3), np.tile(m.radii, copies)


def test_progress_is_told(crambin):
    told = []
    crambin.surface(kind="ses", progress=lambda stage, fraction: told.append((stage, fraction)))
    assert len({stage for stage, _ in told}) > 3 and all(0 <= fraction <= 1 for _, fraction in told)


def test_a_bar_is_shown_by_tqdm(crambin, capsys):
    pytest.importorskip("tqdm")
    crambin.surface(kind="ses", progress=True)
    assert "%" in capsys.readouterr().err


def test_an_exception_of_the_callback_ends_the_run_as_itself(crambin):
    def fail(stage, fraction):
        raise KeyError("mine")
    with pytest.raises(KeyError, match="mine"):
        crambin.surface(progress=fail)
    assert crambin.surface(voxel=1).area > 0


def interrupted(call):
    """Presses Ctrl-C while a call runs, and returns how long that goes on [s]."""
    sent = []
    signal.signal(signal.SIGINT, signal.default_int_handler)  # which Python leaves out in a shell's background

    def interrupt():
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)
    timer = threading.Timer(0.15, interrupt)
    timer.start()
    returned = False
    with pytest.raises(KeyboardInterrupt):
        call()
        returned = True
        time.sleep(5)
    assert not returned, "the run was over before the signal came"
    timer.join()
    return time.perf_counter() - sent[0]


@pytest.mark.parametrize("call", [lambda x, r: ms.surface(x, r, kind="ses", voxel=0.4),
                                  lambda x, r: ms.surface(x, r, voxel=0.4),
                                  lambda x, r: ms.areas(x, r), lambda x, r: ms.contacts(x, r)])
def test_control_c_ends_a_run(call):
    x, r = big()
    x, r = np.concatenate([x, x + 4000]), np.tile(r, 2)
    assert interrupted(lambda: call(x, r)) < 10


def test_control_c_ends_a_reading():
    columns = ["group_PDB", "id", "type_symbol", "label_atom_id", "label_alt_id", "label_comp_id", "label_asym_id",
               "label_entity_id", "label_seq_id", "Cartn_x", "Cartn_y", "Cartn_z", "auth_asym_id", "auth_seq_id"]
    rows = (f"ATOM {i + 1} C CA . GLY A 1 {i + 1} {i % 100} {i // 100 % 100} {i // 10000} A {i + 1}\n" for i in range(400_000))
    text = "data_many\nloop_\n" + "".join(f"_atom_site.{c}\n" for c in columns) + "".join(rows)
    assert interrupted(lambda: ms.read(text)) < 10


def test_other_threads_go_on():
    x, r = big(3)
    beats, stop = [], threading.Event()

    def beat():
        while not stop.is_set():
            beats.append(time.perf_counter())
            time.sleep(0.005)
    thread = threading.Thread(target=beat)
    thread.start()
    begin = time.perf_counter()
    ms.surface(x, r, kind="ses", threads=1)
    took = time.perf_counter() - begin
    stop.set()
    thread.join()
    during = [b for b in beats if begin < b < begin + took]
    assert len(during) >= 5, (len(during), took)  # of 200 a second


def test_threads_at_once_give_the_bits_of_one_after_the_other(crambin):
    def vertices(threads):
        return crambin.surface(kind="ses", voxel=0.7, threads=threads).vertices.tobytes()
    once = vertices(1)
    found = [None] * 4

    def work(k):
        found[k] = vertices(k % 2)
    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [once] * 4


def area_of(molecule):
    return molecule.surface(kind="ses", voxel=1, threads=1)


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes_take_and_give_pickles(crambin, method):
    here = area_of(crambin)
    with multiprocessing.get_context(method).Pool(2) as pool:
        for there in pool.map(area_of, [crambin, crambin]):
            assert np.array_equal(there.vertices, here.vertices) and there.area == here.area


def test_pickles_have_everything():
    m = ms.read(DATA / "1a8o.cif.gz", assembly="1", group_by="copy", kind="ses", voxel=1, color="chain")
    s = m.surface(interfaces=True, curvature_totals=True, fields=["density", "atom_id", "Cd"])
    again = pickle.loads(pickle.dumps(s))
    assert again.report == s.report and repr(again) == repr(s)
    assert pickle.dumps(s) == pickle.dumps(s)
    for name in ("vertices", "faces", "normals", "curvature", "colors", "atom", "atom_areas", "cavities"):
        assert np.array_equal(getattr(again, name), getattr(s, name)), name
    assert again.vertex_data.keys() == s.vertex_data.keys()
    assert all(np.array_equal(a, b) for a, b in zip(again.voxels()[:2], s.voxels()[:2]))
    assert all(np.array_equal(a, b) for a, b in zip(again.contacts, s.contacts))
    points = s.sample(50, seed=1).points
    assert all(np.array_equal(a, b) for a, b in zip(again.distance(points + 1), s.distance(points + 1)))
    for name in ("atoms", "residues", "contacts", "interfaces"):
        one, other = again.table(name), s.table(name)
        assert one.keys() == other.keys() and all(np.array_equal(one[key], other[key]) for key in one), name
    molecule = pickle.loads(pickle.dumps(m))
    assert repr(molecule) == repr(m) and molecule.groups == m.groups and molecule.warnings == m.warnings
    assert np.array_equal(molecule.surface().vertices, m.surface().vertices)
    variational = ms.read(DATA / "1crn.pdb").surface()
    assert variational.report["evolution"]["walls"]
    assert pickle.loads(pickle.dumps(variational)).report == variational.report


def test_damaged_pickles_are_errors(crambin):
    from vdb_molsurf import _core
    state = crambin._core.__getstate__()
    for damaged in (b"", state[:40], state[:-9], b"\xff" * 64):
        with pytest.raises(ValueError):
            _core.Molecule.__new__(_core.Molecule).__setstate__(damaged)
    content = pickle.dumps(crambin.surface(kind="sas", voxel=1, color="chain"))
    random, start = np.random.default_rng(55), content.index(ms.__version__.encode())
    for place in random.integers(start, len(content) - 100, 200):
        changed = bytearray(content)
        changed[place] ^= random.integers(1, 256)
        with pytest.raises(ValueError, match="the pickle is damaged"):
            pickle.loads(bytes(changed))


def test_more_memory_than_there_is_is_refused(crambin):
    """Before it is taken: the whole machine would be."""
    positions = np.mgrid[0:60, 0:60, 0:60].reshape(3, -1).T * 6.0
    with pytest.raises(ms.InputError, match=r"the surface takes about .* GiB of memory, and there are .*`voxel`") as refused:
        ms.surface(positions, 1.7, voxel=0.05)
    assert refused.value.may_pass, "where there is more memory"
    with pytest.raises(ms.InputError, match=r"GiB at a voxel of 0.05 .*`voxel`"):
        ms.surface([[0.0, 0, 0]], 5000.0, kind="sas", voxel=0.05)
