#!/usr/bin/env bash
# Builds and runs all tests. --all (.ci/run calls it so) adds the sanitizers, short fuzz runs and AArch64
# under qemu; scripts/nightly has the long ones.
set -euo pipefail
cd "$(dirname "$0")"
all=0
[[ ${1:-} == --all ]] && all=1

clock=$(mktemp)
trap 'rm -f "$clock"' EXIT
cpu_seconds() {  # sets cpu: user and system time of all commands that have ended
    times >"$clock"
    cpu=$(sed -n '2{s/[ms]/ /g;p}' "$clock" | awk '{printf "%d", 60 * ($1 + $3) + $2 + $4}')
}
table=""
stage() {  # stage NAME COMMAND...: runs it and prints the time it took, by the clock and of processors
    local name=$1 start=$SECONDS before
    shift
    echo "== $name"
    cpu_seconds
    before=$cpu
    "$@"
    cpu_seconds
    echo "== $name: $((SECONDS - start)) s, $((cpu - before)) s of processors"
    table+=$(printf '%8d %8d  %s' $((SECONDS - start)) $((cpu - before)) "$name")$'\n'
}
tests() {  # tests PRESET [ctest options]
    ctest --preset "$1" -j "$(nproc)" "${@:2}"
}

if ((all)); then
    stage "packages" scripts/install --all
    stage "npm validators" scripts/npm_packages
fi
# Files of a room compiled together: 40 % less to compile. A folder keeps the setting that it was made with.
stage "release build" scripts/build release $( ((all)) && echo -DCMAKE_UNITY_BUILD=ON -DKINORA_BENCH=OFF)
if ((all)); then
    stage "tests of ../shared without it" env KINORA_SHARED=/nowhere ctest --preset release -L shared
fi
stage "release tests" tests release
if ((all)); then
    stage "ASan+UBSan build" scripts/build asan:gtests
    stage "ASan+UBSan tests" tests asan
    stage "fuzzing of code" scripts/fuzz build/release code 10
    stage "fuzzing of shaders" scripts/fuzz build/release shaders 4
    stage "fuzzing of sources" scripts/fuzz build/asan text 4
    stage "libFuzzer build" scripts/build fuzzers
    stage "fuzzing of readers" scripts/fuzz_readers 10
    stage "AArch64 build" scripts/cross-arm64
    # Emulated code is ten times slower: fewer random programs, and random shaders in their own stage.
    stage "AArch64 tests" env KINORA_FUZZ=200 KINORA_FUZZ_RSL=10 ctest --preset arm64 -j "$(nproc)"
    stage "AArch64 against x86-64" scripts/same_bits build/release build/arm64
    stage "AArch64 fuzzing of code" scripts/fuzz build/arm64 code 200
    stage "AArch64 fuzzing of shaders" scripts/fuzz build/arm64 shaders 100
fi
cpu_seconds
printf '== stages, in seconds\n   clock      CPU\n%s%8d %8d  all\n' "$table" "$SECONDS" "$cpu"
