#!/usr/bin/env bash
# Builds and runs all tests. --all (.ci/run calls it so) adds the sanitizers, the long fuzz runs and
# AArch64 under qemu.
set -euo pipefail
cd "$(dirname "$0")"
all=0
[[ ${1:-} == --all ]] && all=1

stage() {  # stage NAME COMMAND...: runs it and prints how long it took
    local name=$1 start=$SECONDS
    shift
    echo "== $name"
    "$@"
    echo "== $name: $((SECONDS - start)) s"
}

# CI takes no warnings; a user's newer compiler may have some.
stage "release build" scripts/build release -DKINORA_TESTS=ON -DKINORA_WERROR=$([[ $all == 1 ]] && echo ON || echo OFF)
if ((all)); then stage "npm validators" scripts/npm_packages; fi
stage "release tests" ctest --preset release
if ((all)); then
    stage "ASan+UBSan build" scripts/build asan -DKINORA_TESTS=ON
    stage "ASan+UBSan tests" ctest --preset asan
    stage "fuzzing of code" scripts/fuzz build/release code
    stage "fuzzing of shaders" scripts/fuzz build/release shaders
    stage "fuzzing of sources" scripts/fuzz build/asan text
    stage "libFuzzer build" scripts/build fuzzers
    stage "fuzzing of readers" scripts/fuzz_readers 60
    stage "AArch64 build" scripts/cross-arm64 -DKINORA_WERROR=ON
    # Emulated code is ten times slower: a tenth of the random programs.
    stage "AArch64 tests" env KINORA_FUZZ=200 ctest --preset arm64 -j "$(nproc)"
    stage "AArch64 against x86-64" scripts/same_bits build/release build/arm64
    stage "AArch64 fuzzing of code" scripts/fuzz build/arm64 code 10
    stage "AArch64 fuzzing of shaders" scripts/fuzz build/arm64 shaders 10
fi
