// tests/rsl/objects/class_corpus_test.cpp: class shaders in the manner of public ones, written
// before the compiler ran on them. All of tests/rsl/classes compile, and so do the classes of
// assets/shaders.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "rsl/compile.h"
#include "rsl/lower/lower.h"
#include "tests/folders.h"
#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

// How many files lie below the folder; each compiles and has code.
int compile_classes(const std::string& folder) {
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(project_folder()) / folder)) {
        if (entry.path().extension() != ".sl") continue;
        ++count;
        Diagnostics diagnostics;
        auto shaders = compile_file(entry.path().string(), {}, diagnostics);
        std::string said;
        for (const Finding& finding : diagnostics.findings())
            if (finding.severity == Severity::Error) said += finding.message + "\n";
        EXPECT_EQ(shaders.size(), 1u) << entry.path() << "\n" << said;
        if (shaders.empty()) continue;
        bool plain = entry.path().filename().string().starts_with("pub_");  // co-shaders of 1.x
        EXPECT_TRUE(plain || shaders[0]->definition->shader_class) << entry.path();
        Layer layer{shaders[0].get(), {}};
        EXPECT_TRUE(lower({&layer, 1}, {}, diagnostics)) << entry.path();
    }
    return count;
}

TEST(ClassCorpus, AllOfItCompiles) {
    EXPECT_EQ(compile_classes("tests/rsl/classes"), 91);
}

TEST(ClassCorpus, OurOwnClassesCompile) {
    EXPECT_GE(compile_classes("assets/shaders/classes"), 20);
}

}  // namespace
}  // namespace kinora::rsl
