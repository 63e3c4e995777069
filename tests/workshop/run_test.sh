#!/usr/bin/env bash
# What ./run does about packages, before anything is built. Without root it names the missing ones, prints the line
# that installs them and stops with exit 3; as root it installs. Stubs on PATH play the machine.
# usage: run_test.sh SOURCE_DIR
set -euo pipefail
source_dir=$1
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

# A copy of the script alone, in a folder with a space: no build folder of the real tree is touched.
tree="$work/a tree"
mkdir -p "$tree" "$work/bin"
cp "$source_dir/run" "$source_dir/CMakePresets.json" "$tree/"

stub() { # stub NAME: an executable on PATH with the body from stdin
  { echo '#!/bin/sh'; cat; } >"$work/bin/$1"
  chmod +x "$work/bin/$1"
}
fail() {
  printf 'FAILED: %s\n--- stdout\n%s\n--- stderr\n%s\n' "$1" "$(cat "$work/out")" "$(cat "$work/err")"
  exit 1
}
# run_it EXPECTED_EXIT ARGS...: from another folder, with a bare environment.
run_it() {
  local expected=$1 status=0
  shift
  (cd / && env -i LANG=C "PATH=$work/bin:/usr/bin:/bin" "$tree/run" "$@") >"$work/out" 2>"$work/err" || status=$?
  [[ $status == "$expected" ]] || fail "run $*: exit $status, expected $expected"
}

stub id <<<'echo 1000'
stub sudo <<<'exit 1'
stub apt-get <<<'echo "apt-get must not be called" >&2; exit 99'
stub cmake <<<'echo "cmake must not be called" >&2; exit 98'

# All packages of the list but two.
stub dpkg-query <<'STUB'
shift 3 # -W -f FORMAT
for p in "$@"; do
  case $p in g++ | doctest-dev) ;; *) echo "ii $p" ;; esac
done
exit 1
STUB
for word in build test report "moire list patterns"; do
  # shellcheck disable=SC2086  # the words are separate arguments
  run_it 3 $word
  [[ ! -s $work/out ]] || fail "$word: something on stdout"
  grep -qxF 'error: packages: not installed: g++ doctest-dev; as root, run:' "$work/err" || fail "$word: no error line"
  grep -qxF 'apt-get update && apt-get -o DPkg::Lock::Timeout=900 install -y --no-install-recommends g++ doctest-dev' \
    "$work/err" || fail "$word: the line to run is not exact"
done

# Half-installed packages (removed, configuration files left) are missing too.
stub dpkg-query <<'STUB'
shift 3
for p in "$@"; do
  case $p in cmake) echo "rc $p" ;; *) echo "ii $p" ;; esac
done
STUB
run_it 3 build
grep -qF 'not installed: cmake;' "$work/err" || fail "a half-installed package passed for installed"

# Nothing missing: the build starts, and its exit code comes back.
stub dpkg-query <<'STUB'
shift 3
for p in "$@"; do echo "ii $p"; done
STUB
stub cmake <<<'echo "configuring"; exit 41'
run_it 41 moire list
[[ ! -s $work/out ]] || fail "talk of the build on stdout"

# As root or with sudo the missing ones are installed. Package lists may be stale: after a failure they are refreshed,
# once; a second failure is exit 3.
stub dpkg-query <<'STUB'
shift 3
for p in "$@"; do
  case $p in cmake) ;; *) echo "ii $p" ;; esac
done
STUB
# shellcheck disable=SC2016  # for the stub's shell
stub sudo <<<'[ "$1" = -n ] && shift; exec "$@"'
stub apt-get <<STUB
echo "\$*" >>"$work/apt.log"
case \$* in
  *update) ;;
  *) [ "\$(grep -c 'install -y --no-install-recommends cmake$' "$work/apt.log")" -ge "\$(cat "$work/succeeds_at")" ] ;;
esac
STUB
for uid in 0 1000; do
  stub id <<<"echo $uid"
  echo 2 >"$work/succeeds_at"
  : >"$work/apt.log"
  run_it 41 build
  [[ $(tail -n 2 "$work/apt.log" | head -n 1) == *update ]] || fail "uid $uid: no update before the second attempt"
  echo 9 >"$work/succeeds_at"
  : >"$work/apt.log"
  run_it 3 build
  grep -q '^error: packages: apt-get failed' "$work/err" || fail "uid $uid: no error line"
  [[ ! -s $work/out ]] || fail "uid $uid: talk of apt-get on stdout"
done

# Unknown words are usage errors.
run_it 2 frobnicate
run_it 2
grep -q '^usage:' "$work/err" || fail "no usage"
