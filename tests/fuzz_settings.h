// tests/fuzz_settings.h: how many random programs a test runs, from which seed on, and where it
// writes what fails.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace kinora {

inline uint64_t fuzz_setting(const char* name, uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr && *text != 0 ? std::strtoull(text, nullptr, 10) : otherwise;
}

// Where the second run of a fuzzer starts. The same each time unless KINORA_FUZZ_FRESH gives
// another, so that a build never fails by chance: nightly runs set it (scripts/fuzz).
inline uint64_t fresh_seed() {
    return fuzz_setting("KINORA_FUZZ_FRESH", 1'000'000'000);
}

// Writes a reduced program to <temporary directory>/kinora-fuzz/NAME and gives the path. Kept ones
// go to tests/jit/kept and tests/rsl/kept, which are run as tests.
inline std::string write_reduced(const std::string& name, const std::string& text) {
    std::filesystem::path folder = std::filesystem::temp_directory_path() / "kinora-fuzz";
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    std::filesystem::path path = folder / name;
    std::ofstream(path) << text;
    return path.string();
}

}  // namespace kinora
