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

// Writes a text to <temporary directory>/kinora-fuzz/NAME and gives the path.
inline std::string write_reduced(const std::string& name, const std::string& text) {
    std::filesystem::path folder = std::filesystem::temp_directory_path() / "kinora-fuzz";
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    std::filesystem::path path = folder / name;
    std::ofstream(path) << text;
    return path.string();
}

// Keeps a reduced program that failed as a test: writes it to `folder` (tests/jit/kept or
// tests/rsl/kept in the sources), whose programs every run of the tests compares; to commit it is
// all that is left to do. Where the sources are read-only, to the temporary directory.
inline std::string keep_reduced(const std::string& folder, const std::string& name,
                                const std::string& text) {
    std::string path = folder + "/" + name;
    std::ofstream file(path);
    if (file << text << std::flush) return path;
    return write_reduced(name, text);
}

}  // namespace kinora
