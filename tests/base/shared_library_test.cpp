// tests/base/shared_library_test.cpp: where modules are looked for.
#include "runtime/base/shared_library.h"

#include <gtest/gtest.h>

#include <filesystem>

extern "C" const char* kinora_test_module_path();

namespace kinora {
namespace {

namespace fs = std::filesystem;

struct OwnLibrary : SharedLibrary {
    OwnLibrary() : SharedLibrary(KINORA_OWN_LIBRARY, "tests", "no package") {}
    KINORA_FUNCTION(kinora_test_module_path);
};

TEST(ModulePath, OfAProgramIsBesideItsFolder) {
    const fs::path program = fs::read_symlink("/proc/self/exe");
    EXPECT_EQ(module_path("libx.so"), program.parent_path().parent_path() / "lib/libx.so");
}

TEST(ModulePath, OfALibraryIsBesideTheLibrary) {
    const OwnLibrary& own = opened<OwnLibrary>();
    ASSERT_EQ(own.error(), "");
    EXPECT_EQ(own.kinora_test_module_path(),
              fs::path(KINORA_OWN_LIBRARY).parent_path() / "libx.so");
}

}  // namespace
}  // namespace kinora
