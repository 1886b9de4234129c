#!/bin/bash
# Makes Debian's packages of HEAD in a bare Debian 12, and tries them in two others:
#     scripts/package.sh [--again]
# They are built from `git archive` without a network, with their Build-Depends alone, and lintian looks at them. Then
# README.md's first example is run where nothing but vdb-molsurf is installed, and tests/package/ is built where
# libmolsurf-dev is. They go to build-package/, with the log of the build and lintian's words. --again tries those that are
# there. It needs what scripts/fresh_machine.sh needs, and twenty minutes on 2 cores.
set -euo pipefail
cd "$(dirname "$0")/.."

work=build-package
install="apt-get update -q && apt-get install -q -y --no-install-recommends"
mkdir -p $work
if [[ ${1:-} != --again ]]; then
  rm -f $work/*
  git archive --prefix=vdb-molsurf/ -o $work/source.tar HEAD
  scripts/fresh_machine.sh --share $work \
    "mkdir /srv/build && tar -C /srv/build -xf /srv/shared/source.tar" \
    "apt-get update -q && apt-get build-dep -q -y --no-install-recommends /srv/build/vdb-molsurf > /srv/shared/depends.log" \
    "cd /srv/build/vdb-molsurf && DEB_BUILD_OPTIONS=parallel=$(nproc) unshare --net dpkg-buildpackage -us -uc -b \
      > /srv/shared/build.log 2>&1 || { tail -n 40 /srv/shared/build.log; false; }" \
    "cp /srv/build/*.deb /srv/shared/" \
    "$install lintian > /dev/null && { lintian --allow-root --fail-on error /srv/build/*.changes > /srv/shared/lintian 2>&1; status=\$?
      cat /srv/shared/lintian; exit \$status; }"
  grep -c -e ' -DNDEBUG .*-D_FORTIFY_SOURCE\|-D_FORTIFY_SOURCE.* -DNDEBUG' $work/build.log ||
    { echo "package.sh: no Release build with hardening" >&2; exit 1; }
fi
scripts/fresh_machine.sh --share $work "$install /srv/shared/vdb-molsurf_*.deb" debian/tests/example \
  "dpkg-query -W -f '\${Package} \${Installed-Size} kB\n' vdb-molsurf"
scripts/fresh_machine.sh --share $work "$install cmake g++ make pkg-config /srv/shared/libmolsurf{-dev,1.0}_*.deb > /dev/null" \
  debian/tests/library
