// tests/jit/code_tools_test.cpp: kernels know their lines, and their object files name them.
#include "jit/debug/code_tools.h"
#include "jit/target.h"

#include <elf.h>
#include <gtest/gtest.h>

#include <cstring>

#include "jit/ir/builder.h"

namespace kinora::jit {
namespace {

// x * x on line 1, + 1 on line 2 of a file.
Module two_lines(FileId file) {
    Module module;
    module.name = "two lines";
    add_function(module, "kernel", {});
    Builder b(module, 0);
    Value x = b.input({"x", Type::F, Rate::Point, "", ""});
    b.set_location({file, 0, 5});
    Value square = b.mul(x, x);
    b.set_location({file, 7, 12});
    b.output({"y", Type::F}, b.add(square, b.f(1)));
    b.finish();
    return module;
}

struct Compiled {
    Compiled() {
        FileId file = files.add("two.sl", "x * x;\n y + 1;\n");
        for (const Target& target : targets())
            if (target.supported() && kernel == nullptr &&
                std::string_view(target.name) != "interp")
                kernel = target.emit(two_lines(file), nullptr);
    }
    SourceFiles files;
    std::shared_ptr<Kernel> kernel;
};

TEST(CodeLines, RiseAndEndWhereConstantsBegin) {
    Compiled c;
    if (c.kernel == nullptr) GTEST_SKIP() << "this CPU runs the interpreter only";
    const auto& lines = c.kernel->lines;
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].where.begin, 0u);
    EXPECT_EQ(lines[1].where.begin, 7u);
    EXPECT_LT(lines[0].offset, lines[1].offset);
    EXPECT_LT(lines[1].offset, lines[2].offset);
    EXPECT_LE(lines[2].offset, c.kernel->machine_code.size());
    EXPECT_EQ(lines[2].where.file, kNoFile);
}

TEST(DebugObject, HoldsTheSymbolAndTheLines) {
    Compiled c;
    if (c.kernel == nullptr) GTEST_SKIP() << "this CPU runs the interpreter only";
    std::vector<std::byte> object = debug_object(*c.kernel, &c.files);
    Elf64_Ehdr header;
    ASSERT_GT(object.size(), sizeof header);
    std::memcpy(&header, object.data(), sizeof header);
    ASSERT_EQ(std::memcmp(header.e_ident, ELFMAG, SELFMAG), 0);
    ASSERT_EQ(header.e_shoff + header.e_shnum * sizeof(Elf64_Shdr), object.size());
    std::vector<Elf64_Shdr> sections(header.e_shnum);
    std::memcpy(sections.data(), object.data() + header.e_shoff,
                sections.size() * sizeof(Elf64_Shdr));
    auto text_at = [&](const Elf64_Shdr& section, uint32_t at) {
        return std::string(reinterpret_cast<const char*>(object.data() + section.sh_offset + at));
    };
    const Elf64_Shdr& names = sections[header.e_shstrndx];
    bool symbol = false, lines = false, code = false, unwind = false;
    for (const Elf64_Shdr& section : sections) {
        std::string name = text_at(names, section.sh_name);
        if (name == ".strtab")
            symbol = text_at(section, 1) == "kinora_two_lines_" + std::string(c.kernel->target);
        if (name == ".text")
            code = section.sh_addr == reinterpret_cast<uintptr_t>(c.kernel->machine_code.data()) &&
                   section.sh_size == c.kernel->machine_code.size();
        if (name == ".eh_frame")  // ends with an empty record
            unwind = section.sh_size > 64 && section.sh_size % 8 == 4;
        if (name == ".debug_line") {
            std::string bytes(reinterpret_cast<const char*>(object.data() + section.sh_offset),
                              section.sh_size);
            lines = bytes.find("two.sl") != std::string::npos;
        }
    }
    EXPECT_TRUE(symbol);
    EXPECT_TRUE(code);
    EXPECT_TRUE(lines);
    EXPECT_TRUE(unwind);
}

}  // namespace
}  // namespace kinora::jit
