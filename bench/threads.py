#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Counts the share of a run during which one thread works and no other can.

    bench/threads.py PROGRAM [-j N] [--runs N] -- ARGUMENTS

PROGRAM runs with ARGUMENTS, -v and N threads (4 unless given; more than the machine has cores do no harm). Every
2 ms its threads are looked at in /proc: those in state R can run, whether they have a core or wait for one, so that a
busy machine changes little. Where not more than one can, the processor time that passes counts as serial. TBB's threads
call sched_yield() while they look for work; a library that is preloaded makes them sleep there for 0.1 ms, since they
would count as threads that can run; it also names as many cores as threads, since TBB makes no more threads than cores.

Prints processor seconds, serial ones by stage (medians of the runs), their share, and the speed-up that Amdahl's law
gives for 8, 16 and 64 cores if nothing else bounds it.
"""

import argparse
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

PERIOD = 0.002  # [s]
SLEEPS = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <sched.h>
#include <time.h>
#include <unistd.h>
int sched_yield(void)
{
    struct timespec wait = {0, 100000};
    return nanosleep(&wait, 0);
}
long sysconf(int name)
{
    if (name == _SC_NPROCESSORS_ONLN || name == _SC_NPROCESSORS_CONF) return THREADS;
    return ((long (*)(int))dlsym(RTLD_NEXT, "sysconf"))(name);
}
int sched_getaffinity(pid_t process, size_t size, cpu_set_t* set)
{
    CPU_ZERO_S(size, set);
    for (int i = 0; i < THREADS; ++i) CPU_SET_S(i, size, set);
    return 0;
}
"""


def threads(pid):
    """The number of threads that can run, and the processor seconds of all."""
    running, spent = 0, 0
    for task in os.listdir(f"/proc/{pid}/task"):
        try:
            with open(f"/proc/{pid}/task/{task}/stat", "rb") as file:
                running += file.read().rsplit(b")", 1)[1].split()[0] == b"R"
            with open(f"/proc/{pid}/task/{task}/schedstat", "rb") as file:
                spent += int(file.read().split()[0])
        except (FileNotFoundError, ProcessLookupError):
            pass  # it has ended
    return running, spent * 1e-9


def run(command, library):
    """The processor seconds of a run by stage, [serial, all]."""
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env={**os.environ, "LD_PRELOAD": library})
    begin, steps, before = time.monotonic(), [], (1, 0.0)
    while process.poll() is None:
        try:
            now = threads(process.pid)
        except FileNotFoundError:
            break
        if now[1] > before[1]:  # the last look at a process that ends finds no thread
            steps.append((time.monotonic() - begin, now[1] - before[1], max(now[0], before[0]) < 2))
            before = now
        time.sleep(PERIOD)
    said = process.stderr.read()
    if process.wait() != 0:
        sys.exit(f"threads.py: {' '.join(command)} ended with {process.returncode}:\n{said}")
    ends, end = [], 0.0
    for stage, seconds in re.findall(r"^vdb_molsurf: (\w+) +([\d.]+) s$", said, re.MULTILINE):
        end += float(seconds)
        ends.append((end, stage))
    parts = {}
    for at, spent, alone in steps:
        stage = next((stage for end, stage in ends if at <= end and stage != "total"), "write")
        part = parts.setdefault(stage, [0.0, 0.0])
        part[0] += spent * alone
        part[1] += spent
    return parts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("-j", type=int, default=4, metavar="N", help="threads [4]")
    parser.add_argument("--runs", type=int, default=3, metavar="N", help="runs, of which medians are printed [3]")
    parser.add_argument("arguments", nargs="+")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        library = os.path.join(folder, "sleeps.so")
        subprocess.run(["cc", f"-DTHREADS={asked.j}", "-shared", "-fPIC", "-xc", "-", "-o", library], input=SLEEPS, text=True, check=True)
        runs = [run([asked.program, *asked.arguments, "-v", "--force", "-j", str(asked.j)], library)
                for _ in range(asked.runs)]
    print("| stage | CPU s | serial s |\n|---|---|---|")
    sums = [0.0, 0.0]
    for stage in runs[0]:
        alone, spent = (statistics.median(parts.get(stage, [0.0, 0.0])[k] for parts in runs) for k in (0, 1))
        print(f"| {stage} | {spent:.3f} | {alone:.3f} |")
        sums = [sums[0] + alone, sums[1] + spent]
    share = sums[0] / sums[1]
    print(f"| all | {sums[1]:.3f} | {sums[0]:.3f} |")
    print(f"serial share {100 * share:.1f} %; by Amdahl " +
          ", ".join(f"{1 / (share + (1 - share) / n):.1f} times on {n}" for n in (8, 16, 64)) + " cores")


if __name__ == "__main__":
    main()
