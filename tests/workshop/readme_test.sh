#!/usr/bin/env bash
# README.md does not lie: the commands of its console blocks are run, in order and in one folder, and the README is
# written again with what they print on standard output; it must come out as it was. Lines that start with "$ " are
# commands, those with "> " continue them. And every pattern, filter and scene of the catalogue is named in it.
# When a result has changed for a good reason, --update takes the new text over: read the difference first.
# usage: readme_test.sh SOURCE_DIR FOLDER_OF_THE_PROGRAM [--update]
set -euo pipefail
readme=$1/README.md
PATH=$2:$PATH
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
mkdir "$work/tour"
cd -- "$work/tour"

inside=0 command='' commands=0
flush() {
  [[ -n $command ]] || return 0
  bash -c "$command" </dev/null 2>>"$work/stderr" || true
  commands=$((commands + 1))
  command=''
}
while IFS= read -r line; do
  case $inside:$line in
    '0:```console') inside=1 ;;
    '1:```') flush && inside=0 ;;
    '1:$ '*) flush && command=${line#'$ '} ;;
    '1:> '*) command+=$'\n'${line#'> '} ;;
    1:*) continue ;; # what a command printed when the README was written
  esac
  printf '%s\n' "$line"
done <"$readme" >"$work/again"

status=0
if [[ ${3:-} == --update ]]; then
  cp -- "$work/again" "$readme"
else
  diff -u --label README.md --label 'what its commands print' "$readme" "$work/again" || status=1
fi
# Notes are for a person, with times in them; anything else on standard error is an error.
if grep -v '^note: ' "$work/stderr"; then status=1; fi
((commands >= 5)) || { echo "README.md: only $commands commands found" && status=1; }
for what in patterns filters scenes; do
  while read -r name _; do
    grep -qE "[\`\"]${name}[\`\"]" "$readme" || { echo "README.md: no word of $name ($what)" && status=1; }
  done < <(moire list "$what" | grep '^[a-z]')
done
exit "$status"
