#!/usr/bin/env bash
# Installs the Debian packages that are missing (as root or with sudo), builds Patchlight and its
# tests, and runs every test. Arguments go to ctest: tests/run.sh -R solver
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/../.ci/setup.sh"

build_release

say "testing"
cd "$build/release"
exec ctest --output-on-failure -j "$(parallel_jobs)" "$@" </dev/null
