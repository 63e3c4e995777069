#!/usr/bin/env bash
# README.md does not lie: every command of its console blocks is run, in order and in one folder, and must print exactly
# what the README shows (standard output; of errors too where the command says 2>&1). Lines that start with "$ " are
# commands and those with "> " continue them. And every pattern, filter and scene of the catalogue is named in it.
# usage: readme_test.sh SOURCE_DIR FOLDER_OF_THE_PROGRAM
set -euo pipefail
readme=$1/README.md
PATH=$2:$PATH
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
failed=0 commands=0

# check COMMAND EXPECTED: both may have several lines.
check() {
  local got
  got=$(bash -c "$1" </dev/null 2>>stderr.log || true)
  commands=$((commands + 1))
  [[ $got == "$2" ]] && return
  failed=1
  printf 'README.md: %s\n' "$1"
  diff <(printf '%s\n' "$2") <(printf '%s\n' "$got") || true
}

inside=0 command='' expected=''
flush() {
  [[ -z $command ]] || check "$command" "${expected%$'\n'}"
  command='' expected=''
}
while IFS= read -r line; do
  case $inside:$line in
    '0:```console') inside=1 ;;
    '1:```') flush && inside=0 ;;
    '1:$ '*) flush && command=${line#'$ '} ;;
    '1:> '* | '1:>') command+=$'\n'${line#'>'} && command=${command//$'\n '/$'\n'} ;;
    1:*) expected+=$line$'\n' ;;
  esac
done <"$readme"

((commands >= 5)) || { echo "README.md: only $commands commands found" && failed=1; }
for what in patterns filters scenes; do
  while read -r name _; do
    grep -qF -- "\`$name" "$readme" || grep -qF -- "\"$name\"" "$readme" || { echo "README.md: no word of $what $name" && failed=1; }
  done < <(moire list "$what" | grep '^[a-z]')
done
exit "$failed"
