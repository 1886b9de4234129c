#!/bin/bash
# Runs commands on a fresh machine: a bare Debian 12, with a clone of this repository and nothing else, in a folder
# whose path has a space, without HOME, with LANG=C:
#     scripts/fresh_machine.sh [--user] [--commit COMMIT] [--share FOLDER] [--suite SUITE] [--then COMMAND]... [COMMAND]...
#     scripts/fresh_machine.sh --list
# Without a COMMAND it runs the three of README.md, as printed there (--list prints them). --then adds one that runs
# after them. --user runs them as a user who has sudo, and otherwise they run as root, without sudo. COMMIT is HEAD
# unless it is named. FOLDER of this machine is /srv/shared there. SUITE is another release of Debian: trixie is 13.
#
# It ends with the minutes of each command, and with status 1 at the first one that fails. It needs root (or sudo),
# 8 GB of free memory and debootstrap, which it installs. The system is in memory, in a mount and a process namespace
# of its own: nothing of it is left when the script ends or is killed. The bare system, before any command, is kept in
# build-fresh/ for a week. Debian's mirror, the settings of apt and pip, and proxies are those of this machine.
set -euo pipefail
cd "$(dirname "$0")/.."

root=$PWD/build-fresh/root        # a file system in memory lies over it, which only this script sees
suite=bookworm
place="/srv/a folder/vdb_molsurf" # in the fresh machine
path=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
proxies=(http_proxy https_proxy ftp_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY PIP_INDEX_URL)

fail() {
  echo "fresh_machine.sh: $*" >&2
  exit 1
}

# The commands of README.md, a line each.
readme_commands() {
  local found
  found=$(sed -n '/^## Three commands/,/^## /{/^    /,/^$/s/^    //p}' README.md | head -n 3)
  [[ $(wc -l <<< "$found") -eq 3 ]] || fail "README.md: expected three commands under 'Three commands to begin', got: $found"
  echo "$found"
}

# The folder of Debian's archive that apt uses here.
mirror() {
  local address
  address=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' 2> /dev/null |
    grep -v security | head -n 1) || true
  echo "${address:-http://deb.debian.org/debian}"
}

# Puts apt's settings and proxies of this machine into the fresh one, and its sources if this one is the same Debian.
copy_settings() {
  cp /etc/resolv.conf /etc/hosts "$root/etc/" 2> /dev/null || true
  cp /etc/apt/apt.conf.d/*proxy* "$root/etc/apt/apt.conf.d/" 2> /dev/null || true
  # sudo forgets the variables.
  [[ -z ${http_proxy:-} ]] || echo "Acquire::http::Proxy \"$http_proxy\";" > "$root/etc/apt/apt.conf.d/80proxy"
  grep -q "^VERSION_CODENAME=$suite" /etc/os-release || return 0
  local file
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/debian*.sources /etc/apt/sources.list.d/debian*.list \
              /etc/apt/auth.conf /etc/apt/auth.conf.d/*.conf /etc/apt/apt.conf /etc/apt/apt.conf.d/99*; do
    [[ ! -f $file ]] || cp "$file" "$root$file"
  done
  [[ -f /etc/apt/sources.list ]] || rm -f "$root/etc/apt/sources.list"
}

# Where pip of this machine finds packages, and the certificates that it trusts.
copy_pip_settings() {
  local bundle=${PIP_CERT:-${SSL_CERT_FILE:-}} to=/etc/fresh-machine.crt
  [[ ! -f /etc/pip.conf ]] || cp /etc/pip.conf "$root/etc/"
  [[ -f $bundle ]] || return 0
  mkdir -p "$root${to%/*}"
  cp "$bundle" "$root$to"
  variables+=("PIP_CERT=$to")
}

# Makes the bare system in $root, of the tarball if that is not too old.
make_base() {
  local base=$PWD/build-fresh/$suite.tar
  if [[ -n $(find "$base" -mtime -7 2> /dev/null) ]]; then
    tar -C "$root" -xpf "$base"
    return
  fi
  debootstrap --variant=minbase "$suite" "$root" "$(mirror)" > build-fresh/debootstrap.log 2>&1 ||
    { tail -n 5 build-fresh/debootstrap.log >&2; fail "debootstrap failed, see build-fresh/debootstrap.log"; }
  rm -f "$root"/var/cache/apt/archives/*.deb
  tar -C "$root" --one-file-system -cf "$base.new" .
  mv "$base.new" "$base"
}

# Inside the namespaces, as process 1.
inside() {
  local as_user=$1 commit=$2 share=$3 began=$SECONDS command status=0 report=() variables=(PATH="$path" LANG=C)
  suite=$4
  shift 4
  mount -t tmpfs -o mode=755,size=80% fresh "$root" || fail "a file system in memory cannot be mounted"
  make_base
  copy_settings
  copy_pip_settings
  mount -t proc proc "$root/proc"
  mount --rbind /sys "$root/sys"
  mount --rbind /dev "$root/dev"
  [[ -z $share ]] || { mkdir "$root/srv/shared" && mount --bind "$share" "$root/srv/shared"; }
  # Git refuses the repositories of other users; a user would have cloned as himself.
  printf '[safe]\n\tdirectory = *\n' > "$root/etc/fresh-gitconfig"
  mkdir -p "$root${place%/*}"
  GIT_CONFIG_GLOBAL=$root/etc/fresh-gitconfig git clone -q --no-hardlinks --no-checkout . "$root$place"
  git -C "$root$place" checkout -q --detach "$commit"
  rm "$root/etc/fresh-gitconfig"
  report+=("$(printf '%5s  bare system and clone' "$(minutes $((SECONDS - began)))")")

  local name
  for name in "${proxies[@]}"; do
    [[ -z ${!name:-} ]] || variables+=("$name=${!name}")
  done
  local start=(chroot "$root" env -i "${variables[@]}")
  if [[ $as_user == yes ]]; then
    "${start[@]}" bash -c 'apt-get update -q && apt-get install -q -y --no-install-recommends sudo' > /dev/null
    "${start[@]}" useradd --create-home stranger
    echo 'stranger ALL=(ALL) NOPASSWD: ALL' > "$root/etc/sudoers.d/stranger"
    chown -R --reference="$root/home/stranger" "$root${place%/*}"
    start=(chroot --userspec=stranger:stranger "$root" env -i "${variables[@]}")
  fi
  for command in "$@"; do
    echo "== fresh machine: $command"
    began=$SECONDS
    "${start[@]}" bash -c "cd '$place' && $command" < /dev/null || status=$?
    report+=("$(printf '%5s  %s' "$(minutes $((SECONDS - began)))" "$command")")
    if [[ $status -ne 0 ]]; then
      report+=("       failed with status $status")
      break
    fi
  done
  echo "== fresh machine: minutes"
  printf '%s\n' "${report[@]}" "$(printf '%5s  in all' "$(minutes $SECONDS)")"
  [[ $status -eq 0 ]]
}

minutes() {
  printf '%d:%02d' $(($1 / 60)) $(($1 % 60))
}

if [[ ${1:-} == --inside ]]; then
  shift
  inside "$@"
  exit
fi

as_user=no commit=HEAD share= commands=() after=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --list) readme_commands; exit ;;
    --user) as_user=yes ;;
    --commit) commit=${2:?--commit needs a commit} && shift ;;
    --share) share=$(realpath "${2:?--share needs a folder}") && shift ;;
    --suite) suite=${2:?--suite needs a release of Debian} && shift ;;
    --then) after+=("${2:?--then needs a command}") && shift ;;
    -*) echo "fresh_machine.sh: unknown option $1" >&2; exit 2 ;;
    *) commands+=("$1") ;;
  esac
  shift
done
if [[ ${#commands[@]} -eq 0 ]]; then
  found=$(readme_commands)
  mapfile -t commands <<< "$found"
fi
commit=$(git rev-parse --verify --quiet "$commit^{commit}") || fail "there is no commit $commit"
[[ -z $(git status --porcelain) ]] || echo "fresh_machine.sh: note: uncommitted changes are not in the clone"

as_root=()
[[ $EUID -eq 0 ]] || as_root=(sudo --preserve-env="$(IFS=,; echo "${proxies[*]},PIP_CERT,SSL_CERT_FILE")")
if ! command -v debootstrap > /dev/null; then
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" apt-get install -q -y --no-install-recommends debootstrap
fi
mkdir -p build-fresh/root
"${as_root[@]}" unshare --mount --pid --fork true 2> /dev/null ||
  fail "this system allows no mount and process namespaces, which a fresh machine needs"

# Whoever ends this script ends everything in the namespaces, and with that their mounts.
"${as_root[@]}" setpriv --pdeathsig KILL unshare --mount --pid --fork --kill-child \
  /bin/bash scripts/fresh_machine.sh --inside "$as_user" "$commit" "$share" "$suite" "${commands[@]}" "${after[@]}" &
machine=$!
trap '"${as_root[@]}" kill -KILL $machine; exit 130' INT TERM HUP
wait $machine
