#!/bin/bash
# Tables 3.1 and 3.2 of the paper, and its comparison of the two regularisers, for structure files:
#     scripts/paper_tables.sh [NAME=]FILE ... [-o FILE.md] [-o FILE.json] [options]
# --help lists the options. Needs Python only.
exec /usr/bin/python3 -B "$(dirname "$0")/paper_tables.py" "$@"
