// runtime/programs/convert/code_links.cpp: files that RSL code names, as seen from another folder.
#include "runtime/programs/convert/code_links_p.h"

#include <map>

#include "collada/document/edit.h"
#include "runtime/base/regular_file.h"
#include "runtime/scene/description/rsl_literals.h"

namespace kinora {

namespace fs = std::filesystem;

namespace {

// Texts in place of ranges of the code, by where they begin.
using Replacements = std::map<size_t, std::pair<size_t, std::string>>;

std::string replaced(std::string code, const Replacements& replacements) {
    for (auto at = replacements.rbegin(); at != replacements.rend(); ++at)
        code.replace(at->first, at->second.first - at->first, at->second.second);
    return code;
}

std::string text_of(const std::string& code, LiteralRange range) {
    return code.substr(range.begin, range.end - range.begin);
}

}  // namespace

std::optional<std::string> CodeLinks::moved_code(const fs::path& file) {
    if (*file.lexically_relative(folder_).begin() == "..") return {};  // no one reads that
    std::optional<std::string> code = read_regular_file(file.string());
    if (!code || --files_left_ < 0 || !open_.insert(file).second) return {};
    Replacements replacements;
    bool names_files = false;
    for (LiteralRange literal : string_literals(*code)) {
        std::string name = text_of(*code, literal);
        fs::path named = (folder_ / name).lexically_normal();
        if (!may_name_file(name) || !is_regular_file(named.string())) continue;
        replacements[literal.begin] = {literal.end, moved_(named, true)};
        names_files = true;
    }
    for (const IncludeLine& include : include_lines(*code)) {
        fs::path header = (file.parent_path() / text_of(*code, include.name)).lexically_normal();
        if (!is_regular_file(header.string())) continue;  // one of -I, or Kinora's own
        std::optional<std::string> text = moved_code(header);
        names_files |= text.has_value();
        if (text)
            replacements[include.line.begin] = {include.line.end, *text};
        else
            replacements[include.name.begin] = {include.name.end, moved_(header, false)};
    }
    open_.erase(file);
    if (!names_files) return {};
    return replaced(*code, replacements);
}

bool in_section(std::string_view document, const collada::Element& e, uint32_t byte) {
    std::string_view before = document.substr(e.start_tag.end, byte - e.start_tag.end);
    size_t section = before.rfind("<![CDATA[");
    return section != before.npos && before.find("]]>", section) == before.npos;
}

std::string code_text(const std::string& code, bool in_section) {
    if (!in_section) return collada::escape_text(code);
    constexpr size_t kOpen = 9, kClose = 3;  // <![CDATA[ and ]]>
    std::string text = collada::cdata(code);
    return text.substr(kOpen, text.size() - kOpen - kClose);
}

}  // namespace kinora
