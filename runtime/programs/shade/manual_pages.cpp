// runtime/programs/shade/manual_pages.cpp: the tables of the language as Markdown.
#include "runtime/programs/shade/manual_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "rsl/builtins/table.h"
#include "rsl/model/globals.h"
#include "rsl/model/pairs.h"
#include "rsl/text/findings.h"
#include "runtime/base/check.h"
#include "runtime/programs/manual/rows.h"
#include "runtime/programs/manual/statements.h"
#include "runtime/scene/aovs/aovs.h"

namespace kinora {

namespace {

std::string code_list(const std::vector<std::string>& names) {
    return fmt::format("`{}`", fmt::join(names, " "));
}

// A bar would end the cell.
std::string cell(std::string text) {
    for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
        text.insert(at, "\\");
    return text;
}

void add_row(std::string& page, const std::vector<std::string>& cells) {
    for (const std::string& text : cells) page += fmt::format("| {} ", text);
    page += "|\n";
}

void add_head(std::string& page, const std::vector<std::string>& cells) {
    add_row(page, cells);
    add_row(page, std::vector<std::string>(cells.size(), "---"));
}

// The names of a callee's optional parameters that change something, are set, or change nothing.
struct OptionNames {
    std::vector<std::string> work, results, idle;
};
OptionNames options_of(std::string_view callee) {
    OptionNames names;
    for (const rsl::OptionalParameter& option : rsl::optional_parameters()) {
        if (!rsl::is_taker(option, callee)) continue;
        (option.idle     ? names.idle
         : option.result ? names.results
                         : names.work)
            .emplace_back(option.name);
    }
    return names;
}

void add_item(std::string& page, const char* before, const std::vector<std::string>& names,
              const char* after = "") {
    if (!names.empty()) page += fmt::format("- {}: {}{}\n", before, code_list(names), after);
}

void add_options(std::string& page, std::string_view callee) {
    OptionNames names = options_of(callee);
    add_item(page, "Optional parameters", names.work);
    add_item(page, "Optional results", names.results);
    add_item(page, "Accepted without effect", names.idle);
}

bool takes_pairs(const rsl::Builtin& row) {
    std::vector<rsl::Signature> signatures = rsl::parse_signatures(row.signature);
    return std::any_of(signatures.begin(), signatures.end(),
                       [](const rsl::Signature& signature) { return signature.pairs; });
}

void add_builtin(std::string& page, const rsl::Builtin& row) {
    page += "```\n";
    for (const BuiltinForm& form : builtin_forms(row)) page += form.line() + "\n";
    page += fmt::format("```\n\n{}\n\n", row.doc);
    size_t before = page.size();
    if (row.legal != rsl::kAnyShader) add_item(page, "Only in", kind_names(row.legal), " shaders");
    for (const std::string& text : effect_texts(row)) page += fmt::format("- It {}.\n", text);
    if (*row.globals) page += fmt::format("- It reads `{}` too.\n", row.globals);
    if (row.tolerance_ulp > 0) page += fmt::format("- Error: {} ULP at most\n", row.tolerance_ulp);
    if (takes_pairs(row)) add_options(page, row.name);
    if (row.effects & rsl::kReadsChannels) page += "- Other pairs: a channel and its variable\n";
    if (row.effects & rsl::kWritesChannels) page += "- Other pairs: a channel and its value\n";
    if (!row.lower) page += "- Known, but not supported yet\n";
    if (page.size() > before) page += "\n";
}

std::string value_text(const rsl::OptionalParameter& option) {
    if (option.result) return "a variable that is set";
    return option.type == rsl::BaseType::Invalid ? "any" : rsl::type_name(option.type);
}

// A row a name.
void add_option_table(std::string& page) {
    page += "## Optional parameters\n\n";
    page +=
        "Behind the positional arguments follow pairs of a name and a value, as in "
        "`trace(P, R, \"samples\", 16)`.\n\n";
    add_head(page, {"name", "value", "does something in", "accepted without effect in"});
    std::span<const rsl::OptionalParameter> options = rsl::optional_parameters();
    std::vector<std::string_view> done;
    for (const rsl::OptionalParameter& first : options) {
        if (std::find(done.begin(), done.end(), first.name) != done.end()) continue;
        done.push_back(first.name);
        const rsl::OptionalParameter* shown = nullptr;  // the first that does something
        std::string takers[2];
        for (const rsl::OptionalParameter& option : options) {
            if (option.name != first.name) continue;
            if (!shown || (shown->idle && !option.idle)) shown = &option;
            std::string& list = takers[option.idle != nullptr];
            list += (list.empty() ? "" : " ") + std::string(option.takers);
        }
        add_row(page, {fmt::format("`{}`", first.name), value_text(*shown), takers[0], takers[1]});
    }
}

std::string builtins_page() {
    std::string page =
        "# The built-in functions\n\n"
        "<!-- generated by scripts/docs from the rows of rsl/builtins and rsl/model/pairs.cpp -->"
        "\n\n"
        "The first lines of an entry are the function's forms: `T` stands for one of the types "
        "behind it.\n"
        "ULP are units in the last place, against the same function in double precision, with "
        "`--math precise`. [Numerics](numerics.md) says how they are measured.\n"
        "A parameter that is accepted without effect keeps shaders of other renderers alive. "
        "Where that could change the picture, a finding says so.\n\n";
    for (const rsl::BuiltinGroup& group : rsl::builtin_groups()) {
        page += fmt::format("## {}\n\n", group.title);
        std::string_view last;
        for (const rsl::Builtin& row : group) {
            if (row.effects & rsl::kForHeaders) continue;
            if (last != row.name) page += fmt::format("### {}\n\n", row.name);
            last = row.name;
            add_builtin(page, row);
        }
    }
    page += "## The gather statement\n\n";
    add_options(page, "gather");
    page += "\n";
    add_option_table(page);
    return page;
}

// "read", "read, write" or nothing: what shaders of the kind may do with the global.
std::string access(const rsl::GlobalInfo& global, rsl::ShaderKind kind) {
    bool reads = global.readers & rsl::in_kind(kind), writes = global.writers & rsl::in_kind(kind);
    return reads && writes ? "rw" : reads ? "r" : writes ? "w" : "";
}

std::string globals_page() {
    constexpr rsl::ShaderKind kLast = rsl::ShaderKind::Transformation;
    std::string page;
    std::vector<std::string> head = {"global", "type", "rate"};
    for (int kind = 0; kind <= int(kLast); ++kind)
        head.push_back(rsl::shader_kind_name(rsl::ShaderKind(kind)));
    head.push_back("meaning");
    add_head(page, head);
    for (const rsl::GlobalInfo& global : rsl::globals()) {
        std::vector<std::string> cells = {fmt::format("`{}`", global.name),
                                          rsl::type_name(global.type), rsl::rate_name(global.rate)};
        for (int kind = 0; kind <= int(kLast); ++kind)
            cells.push_back(access(global, rsl::ShaderKind(kind)));
        cells.push_back(cell(global.doc));
        add_row(page, cells);
    }
    return page;
}

std::string words_page() {
    const std::vector<std::string> words = {
#define WORD(name, text) text,
#include "rsl/text/words.def"
#undef WORD
    };
    const std::vector<std::string> puncts = {
#define PUNCT(name, text) text,
#include "rsl/text/puncts.def"
#undef PUNCT
    };
    return fmt::format(
        "Words of the grammar: {}\n\n"
        "Punctuators, with those that only other languages use: {}\n",
        code_list(words), code_list(puncts));
}

std::string findings_page() {
    std::string page;
    add_head(page, {"finding", "severity", "meaning"});
    for (const FindingInfo* row : rsl::finding_rows())
        add_row(page, {fmt::format("`{}`", row->code), severity_name(row->severity),
                       cell(row->explanation)});
    return page;
}

std::string statements_page() {
    std::string page;
    for (const ManualChapter& chapter : manual_chapters()) {
        page += fmt::format("### {}\n\n", chapter.title);
        for (const ManualEntry& entry : chapter.entries) {
            page +=
                fmt::format("`{}`\n\n{}\n\n```c\n{}```\n\n", entry.form, entry.text, entry.example);
            if (!entry.attach.empty())
                page += fmt::format("In a scene:\n\n```xml\n{}```\n\n", entry.attach);
        }
    }
    page.pop_back();
    return page;
}

struct Page {
    std::string_view name;
    std::string (*text)();
};
constexpr Page kPages[] = {
    {"builtins", builtins_page},     {"globals", globals_page},   {"words", words_page},
    {"statements", statements_page}, {"findings", findings_page}, {"aovs", aov_table},
};

}  // namespace

std::vector<std::string_view> manual_pages() {
    std::vector<std::string_view> names;
    for (const Page& page : kPages) names.push_back(page.name);
    return names;
}

std::string manual_page(std::string_view name) {
    for (const Page& page : kPages)
        if (page.name == name) return page.text();
    return "";
}

}  // namespace kinora
