#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: The SLAMBench authors
#
# What scripts/gpu-check says before it builds anything: status and message.
set -euo pipefail

script="$(dirname "$(readlink -f "$0")")/../../scripts/gpu-check"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"

expect() {
  local status="$1" message="$2" found=0
  shift 2
  "$script" "$@" >out 2>err || found=$?
  if ((found != status)) || ! grep -qF -- "$message" out err; then
    echo "gpu-check $*: found status $found, expected $status with '$message'; it said:" >&2
    cat out err >&2
    exit 1
  fi
}

expect 0 'gpu-check [options] SEQUENCE' --help
expect 2 'found no sequence'
expect 2 "found option '--fast'" --fast
expect 2 '--out: found nothing' a.raw --out
expect 2 "found a second sequence 'b.raw'" a.raw b.raw
expect 3 'a.raw: cannot read the sequence' a.raw
touch a.raw
expect 3 'my.toml: cannot read the settings' a.raw --config my.toml
expect 2 "--limit: found 'soon'" a.raw --limit soon
expect 2 '--backend: found nothing' a.raw --backend
mkdir debs
expect 4 'found no .deb file in debs' a.raw --debs debs --out out-folder --build build
# 8 seconds, not an octal number; they have passed.
SECONDS=100 expect 1 'NOT RUN  no time left' a.raw --limit 08 --backend serial --out out-folder \
  --build build
echo "gpu-check says what it finds"
