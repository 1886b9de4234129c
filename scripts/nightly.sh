#!/bin/bash
# Runs what takes too long for .ci/run, one after the other, and prints one table at the end:
#     scripts/nightly.sh [--fuzz SECONDS] [--structures FOLDER] [NAME...]
# Without a NAME it runs all:
#     headers     those that no source file includes first, each compiled by itself
#     mutations   scripts/mutate.py: the code broken on purpose, which tests have to notice
#     fuzzing     scripts/fuzz.sh: each target for 60 seconds, or SECONDS
#     asan, tsan  scripts/sanitizers.sh: the unit tests under the sanitizers of addresses and of threads
#     surfaces    tests/surfaces/random_surfaces.py: 400 surfaces of proteins, each held against its report
#     poses       bench/rotations.py: Euler numbers that have to be the same in nine of ten poses
#     calls       tests/surfaces/random_calls.py: 20,000 calls with mutated files and options, under sanitizers
#     guides      the printed commands of README.md and of all guides, one after the other in one clone
#     figures     scripts/check_docs.py --figures: the numbers of the pages, some of structures that are in FOLDER
#     estimates   bench/estimates.py: seconds and memory of --dry-run beside those of runs; capsids of FOLDER, too
#     wheel       scripts/wheel.sh: the Python module, its wheel and its tests
#     package     scripts/package.sh: Debian's packages, built and tried in bare systems
#     kernel      the kernel configured and built alone, with OpenVDB and TBB, and its example run
#     examples    tests/examples: the additions of CONTRIBUTING.md, built and used
#     site        scripts/docs.sh: the pages as a site
#     slurm       scripts/workflow/test_slurm.sh: the workflow of Snakemake on a Slurm of this machine
# All of it takes some hours on 2 cores, in some 6 GB. What a step prints is in build-nightly/NAME.log. The exit
# status is 1 if one fails; the others still run.
set -euo pipefail
cd "$(dirname "$0")/.."

headers() {
  cmake --preset release -DCMAKE_VERIFY_INTERFACE_HEADER_SETS=ON &&
    cmake --build --preset release --target all_verify_interface_header_sets
}
mutations() { scripts/mutate.py; }
fuzzing() { scripts/fuzz.sh "$seconds"; }
asan() { scripts/sanitizers.sh asan; }
surfaces() {
  cmake --preset release && cmake --build --preset release --target vdb_molsurf &&
    tests/surfaces/random_surfaces.py build-release/tools/vdb_molsurf --runs 400 "${structures[@]}"
}
poses() {
  local file=(tests/data/{4at1.ent.gz,1a8o.cif.gz,bpti.pdb.gz}) same=0
  [[ ${#structures[@]} -eq 0 ]] || file+=("${structures[1]}"/{1ehz.cif.gz,1igy.cif.gz,1u19.cif.gz,4hhb.cif.gz})
  cmake --preset release && cmake --build --preset release --target vdb_molsurf || return 1
  for f in "${file[@]}"; do bench/rotations.py build-release/tools/vdb_molsurf "$f" --least 9 || same=1; done
  return $same
}
calls() {
  export LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp:print_suppressions=0 ASAN_OPTIONS=detect_container_overflow=0
  cmake --preset fuzz && cmake --build --preset asan --target vdb_molsurf &&
    seq 1 4 | xargs -P "$(nproc)" -I {} tests/surfaces/random_calls.py build-fuzz/tools/vdb_molsurf --runs 5000 \
      --seed {} --keep build-nightly/calls
}
tsan() { scripts/sanitizers.sh tsan; }
guides() {
  cmake --preset release && cmake --build --preset release --target vdb_molsurf vdb_molsurf_msms vdb_molsurf_nanoshaper &&
    MOLSURF_ALL_GUIDES=1 VDB_MOLSURF=build-release/tools/vdb_molsurf \
      /usr/bin/python3 -B tests/cli/test_readme.py -v Readme.test_pages_in_one_clone
}
figures() {
  cmake --preset release && cmake --build --preset release --target vdb_molsurf &&
    scripts/install_deps.sh gemmi pdb2pqr apbs-data && scripts/paper_structures.sh paper &&
    scripts/check_docs.py --figures "${structures[@]}"
}
estimates() {
  cmake --preset release && cmake --build --preset release --target vdb_molsurf &&
    bench/estimates.py build-release/tools/vdb_molsurf "${structures[@]}"
}
wheel() { scripts/wheel.sh; }
package() { scripts/package.sh; }
kernel() { tests/package/kernel/standalone.sh; }
examples() { tests/examples/check_examples.py --build build-examples; }
site() { scripts/docs.sh; }
slurm() {
  cmake --preset release && cmake --build --preset release --target vdb_molsurf && scripts/workflow/test_slurm.sh
}

seconds=60 structures=() steps=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --fuzz) seconds=${2:?--fuzz needs seconds} && shift ;;
    --structures) structures=(--structures "${2:?--structures needs a folder}") && shift ;;
    headers | mutations | fuzzing | asan | tsan | surfaces | poses | calls | guides | figures | estimates | wheel | package | kernel | examples | site | slurm) steps+=("$1") ;;
    *) echo "nightly.sh: expected a step or an option, got $1 [hint: see the first lines of this script]" >&2; exit 2 ;;
  esac
  shift
done
[[ ${#steps[@]} -gt 0 ]] || steps=(headers mutations fuzzing asan tsan surfaces poses calls guides figures estimates wheel package kernel examples site slurm)

scripts/install_deps.sh --test --check clang libclang-rt-dev dpkg-dev
mkdir -p build-nightly
status=0 table=()
for step in "${steps[@]}"; do
  echo "== $step"
  began=$SECONDS verdict=passed
  "$step" < /dev/null > "build-nightly/$step.log" 2>&1 || { verdict=FAILED status=1; }
  last=$(grep -E '^(.*tests passed.*|.* faults.*|most: .*|.* killed.*|Made in .*|.* passed.* in .*|.* s of CPU.*|.*ninja: no work.*)$' "build-nightly/$step.log" | tail -n 1 || true)
  table+=("$(printf '%-10s %-7s %3d:%02d  %s' "$step" "$verdict" $(((SECONDS - began) / 60)) $(((SECONDS - began) % 60)) \
    "${last:-$(tail -n 1 "build-nightly/$step.log")}")")
  echo "${table[-1]}"
done
printf '\n%-10s %-7s minutes  what it says\n' step verdict
printf '%s\n' "${table[@]}"
exit $status
