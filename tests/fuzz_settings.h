// tests/fuzz_settings.h: how many random programs a test runs, from which seed on, and where it
// writes what fails.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace kinora {

inline uint64_t fuzz_setting(const char* name, uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr && *text != 0 ? std::strtoull(text, nullptr, 10) : otherwise;
}

// A seed nobody has run, printed by the test that takes it; KINORA_FUZZ_FRESH repeats one.
inline uint64_t fresh_seed() {
    static const uint64_t seed =
        fuzz_setting("KINORA_FUZZ_FRESH", (uint64_t(std::random_device{}()) << 8) + 1'000'000'000);
    return seed;
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
