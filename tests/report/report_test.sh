#!/usr/bin/env bash
# Runs one file of browser tests: report_test.sh NODE FILE. Without Chromium it says so and exits with 77: skipped.
set -euo pipefail
chromium=${MOIRE_CHROMIUM:-$(command -v chromium || command -v chromium-browser || true)}
if [[ -z $chromium ]]; then
  echo "skipped: no chromium (apt-get install chromium)"
  exit 77
fi
MOIRE_CHROMIUM=$chromium exec "$1" --test --test-reporter=spec --test-timeout=240000 "$2"
