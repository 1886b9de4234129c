#!/usr/bin/env python3
# SPDX-License-Identifier: MPL-2.0
"""Makes src/molsurf/molecule/structure/residue_bonds.inc: the bonds between heavy atoms of residues that files often have.

    python3 -m venv v && v/bin/pip install biotite==1.6.0 && v/bin/python scripts/residue_bonds.py

They are of the Chemical Component Dictionary of the wwPDB (CC0), which biotite carries along."""

import pathlib

from biotite.structure import BondType
from biotite.structure.info import bonds_in_residue

POLYMERS = """ALA ARG ASN ASP CYS GLN GLU GLY HIS ILE LEU LYS MET PHE PRO SER THR TRP TYR VAL MSE SEC PYL HYP SEP TPO PTR CSO
CME KCX MLY M3L CGU PCA ACE NH2 NME ORN CSD OCS LLP A C G U I N DA DC DG DT DI DU PSU 5MC 5MU H2U OMC OMG 1MA 2MG 7MG
M2G YYG 4SU 6MZ CBV 5CM 8OG"""
LIGANDS = """HEM HEC HEA HEB SRM ATP ADP AMP ANP ACP AGS ADN GTP GDP GMP 5GP GNP GSP UDP UTP UMP U5P CTP CDP CMP C5P TTP TMP
TYD DTP DCP DGT CMP 2GP NAD NAI NAP NDP FAD FMN RBF COA ACO SAM SAH TPP PLP PMP BTN THF FOL MTX DHF B12 COB F43 MGD MTE
NAG NDG BMA MAN GAL GLA GLC BGC FUC FUL XYS XYP SIA FRU SUC LAT MAL TRE GCU G6P F6P FBP PEP PGA 3PG GOL EDO PEG PGE PG4
1PE P6G MPD MRD IPA EOH ACT ACY FMT CIT FLC TLA SIN MLI MES EPE TRS BTB BME DTT DMS IMD SO4 PO4 PI NO3 CO3 SCN VO4 ALF BEF
SF4 FES F3S CLA CL1 CHL BCL BPH PHO BCR RET LMT BOG OLA OLC PLM MYR STE CLR CHD PC1 PEE LHG POV LDA UNL GSH AKG OXL PYR
MLT ASC SPM SPD EST TES STR DEX CFF NIC IHP I3P 4IP INS STU BEN GAI URE"""
ORDER = {BondType.DOUBLE: "=", BondType.TRIPLE: "#", BondType.AROMATIC_SINGLE: ":", BondType.AROMATIC_DOUBLE: ":",
         BondType.AROMATIC: ":"}

rows = {}
for name in dict.fromkeys((POLYMERS + " " + LIGANDS).split()):
    bonds = bonds_in_residue(name)
    heavy = [(a, b, ORDER.get(order, "-")) for (a, b), order in bonds.items()
             if not any(x.lstrip("0123456789")[:1] in ("H", "D") and x not in ("HG",) for x in (a, b))]
    if heavy:
        rows[name] = " ".join(f"{a}{order}{b}" for a, b, order in heavy)
    else:
        print(f"{name}: none")
path = pathlib.Path(__file__).resolve().parents[1] / "src" / "molsurf" / "structure" / "residue_bonds.inc"
path.write_text("// Made by scripts/residue_bonds.py of the Chemical Component Dictionary of the wwPDB (CC0).\n" +
                "".join(f'{{"{name}", "{bonds}"}},\n' for name, bonds in sorted(rows.items())))
print(len(rows), "residues,", path.stat().st_size, "bytes")
