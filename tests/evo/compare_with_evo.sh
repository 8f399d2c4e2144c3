#!/bin/sh
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: The SLAMBench authors
# Compares the figures of `slambench evaluate` with those of the Python package evo. Its interpreter
# is SLAMBENCH_EVO_PYTHON, else python3; without evo the test is skipped (status 77).
python=${SLAMBENCH_EVO_PYTHON:-python3}
if ! "$python" -c 'import evo' 2>/dev/null; then
  echo "skipped: $python has no package evo (pip install evo; SLAMBENCH_EVO_PYTHON names its python)"
  exit 77
fi
exec "$python" "$(dirname "$0")/../../scripts/check_with_evo.py" "$@"
