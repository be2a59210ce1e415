// runtime/programs/shade/manual.cpp: the manual of the language on the terminal.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "rsl/builtins/table.h"
#include "rsl/model/globals.h"
#include "runtime/base/diagnostic.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/manual/rows.h"
#include "runtime/programs/manual/statements.h"
#include "runtime/programs/shade/kinora_shade.h"
#include "runtime/programs/shade/manual_pages.h"

namespace kinora {

namespace {

std::string kinds_of(uint32_t mask) {
    std::vector<std::string> names = kind_names(mask);
    return names.empty() ? "nobody" : fmt::format("{}", fmt::join(names, " "));
}

void print_row(const rsl::Builtin& row) {
    for (const BuiltinForm& form : builtin_forms(row)) std::printf("%s\n", form.line().c_str());
    std::printf("    %s\n", row.doc);
    for (const std::string& text : effect_texts(row)) std::printf("    It %s.\n", text.c_str());
    if (row.legal != rsl::kAnyShader)
        std::printf("    Only in %s shaders.\n", kinds_of(row.legal).c_str());
    if (row.tolerance_ulp > 0)
        std::printf("    Precise mathematics is within %d ULP.\n", row.tolerance_ulp);
    if (!row.lower) std::printf("    Known, but not supported yet.\n");
}

void print_global(const rsl::GlobalInfo& global, bool whole) {
    if (!whole) {
        std::printf("%-18s %s\n", std::string(global.name).c_str(),
                    std::string(global.doc).c_str());
        return;
    }
    std::printf("%s\n    %s\n    read by %s, written by %s\n",
                fmt::format("{} {}", rsl::type_name(global.type), global.name).c_str(),
                std::string(global.doc).c_str(), kinds_of(global.readers).c_str(),
                kinds_of(global.writers).c_str());
}

std::string indented(std::string_view text) {
    std::string result;
    for (size_t at = 0; at < text.size();) {
        size_t end = std::min(text.find('\n', at), text.size());
        result += fmt::format("    {}\n", text.substr(at, end - at));
        at = end + 1;
    }
    return result;
}

void print_entry(const ManualEntry& entry) {
    std::printf("%s\n    %s\n\n%s", std::string(entry.form).c_str(),
                std::string(entry.text).c_str(), indented(entry.example).c_str());
    if (!entry.attach.empty())
        std::printf("\n    In a scene:\n\n%s", indented(entry.attach).c_str());
}

// All of them without a name; else those that have it.
bool print_chapters(const std::string& name) {
    bool found = false;
    for (const ManualChapter& chapter : manual_chapters()) {
        if (name.empty()) std::printf("\n%s\n", std::string(chapter.title).c_str());
        for (const ManualEntry& entry : chapter.entries) {
            if (name.empty())
                std::printf("  %s\n", std::string(entry.form).c_str());
            else if (entry.has_name(name))
                print_entry(entry);
            found |= entry.has_name(name);
        }
    }
    return found;
}

}  // namespace

int shade_manual(const ShadeOptions& options) {
    if (!options.markdown.empty()) {
        std::fputs(manual_page(options.markdown).c_str(), stdout);
        return kExitOk;
    }
    bool found = false;
    for (std::span<const rsl::Builtin> group : rsl::builtin_groups())
        for (const rsl::Builtin& row : group) {
            if (options.source.empty() && (row.effects & rsl::kForHeaders)) continue;
            if (options.source.empty())
                std::printf("%-18s %s%s\n", row.name, row.doc,
                            row.lower ? "" : " (not supported yet)");
            else if (options.source == row.name)
                print_row(row);
            found |= options.source.empty() || options.source == row.name;
        }
    for (const rsl::GlobalInfo& global : rsl::globals()) {
        if (!options.source.empty() && options.source != global.name) continue;
        print_global(global, !options.source.empty());
        found = true;
    }
    found |= print_chapters(options.source);
    if (found) return kExitOk;
    std::vector<std::string_view> names;
    for (const auto& name : rsl::builtin_names()) names.push_back(name);
    for (const rsl::GlobalInfo& global : rsl::globals()) names.push_back(global.name);
    for (const ManualChapter& chapter : manual_chapters())
        for (const ManualEntry& entry : chapter.entries) names.push_back(entry.names);
    std::string_view near = nearest_name(options.source, names);
    std::fprintf(stderr, "kinora-shade: the language has no '%s'%s\n", options.source.c_str(),
                 near.empty() ? "; kinora-shade manual lists all"
                              : fmt::format("; did you mean '{}'?", near).c_str());
    return kExitUsage;
}

}  // namespace kinora
