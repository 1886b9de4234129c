#!/bin/bash
# Writes the structures of docs/development/paper.md that have hydrogens, as PQR files with CHARMM's radii:
#     scripts/paper_structures.sh FOLDER
# Needs the Debian packages gemmi, pdb2pqr and apbs-data (scripts/install_deps.sh installs what it is
# given).
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1"
cd "$1"

# 1A8O: the dimer; pdb2pqr knows methionine but not selenomethionine.
gemmi convert --assembly=1 "$root/tests/data/1a8o.cif.gz" dimer.pdb
sed -E 's/^(HETATM|ATOM  )(.{11})MSE/ATOM  \2MET/; s/^(ATOM.{8})SE   MET/\1 SD  MET/' dimer.pdb |
  grep -E '^(ATOM|TER)' | cut -c1-66 > 1a8o.pdb
gzip -dc "$root/tests/data/4at1.ent.gz" | grep -E '^(ATOM|TER)' | cut -c1-66 > 4at1.pdb
for name in 1a8o 4at1; do
  pdb2pqr --ff=CHARMM --noopt --drop-water --log-level=ERROR $name.pdb $name.pqr
done
# 1MAH: acetylcholinesterase and fasciculin, each with hydrogens.
cat /usr/share/apbs/examples/misc/{mache,fas2}.pqr > 1mah.pqr
rm -f dimer.pdb 1a8o.pdb 4at1.pdb ./*.log
