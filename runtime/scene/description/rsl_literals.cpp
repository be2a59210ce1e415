// runtime/scene/description/rsl_literals.cpp: string literals of RSL code that name files.
#include "runtime/scene/description/rsl_literals.h"

#include <algorithm>
#include <filesystem>

namespace kinora {

namespace fs = std::filesystem;

namespace {

// Behind the next `end`, or where the code ends.
size_t behind(std::string_view code, std::string_view end, size_t from) {
    size_t found = code.find(end, from);
    return found == code.npos ? code.size() : found + end.size();
}

// Where the literal that opens at `open` closes; where its line ends if it does not.
size_t end_of_literal(std::string_view code, size_t open) {
    size_t end = open + 1;
    while (end < code.size() && code[end] != '"' && code[end] != '\n')
        end += code[end] == '\\' ? 2 : 1;
    return std::min(end, code.size());
}

bool is_include(std::string_view code, size_t hash) {
    size_t word = code.find_first_not_of(" \t", hash + 1);
    return word != code.npos && code.substr(word).starts_with("include");
}

// Calls literal(open, close) with the quotes' places and include(hash) outside comments.
template <class Literal, class Include>
void scan(std::string_view code, Literal&& literal, Include&& include) {
    bool line_starts = true;
    for (size_t at = 0; at < code.size();) {
        std::string_view rest = code.substr(at);
        bool starts_line = line_starts;
        line_starts = rest[0] == '\n' || (starts_line && (rest[0] == ' ' || rest[0] == '\t'));
        if (rest.starts_with("//")) {
            at = behind(code, "\n", at);
            line_starts = true;
        } else if (rest.starts_with("/*")) {
            at = behind(code, "*/", at + 2);
        } else if (rest[0] == '#' && starts_line && is_include(code, at)) {
            include(at);
            at = behind(code, "\n", at);
            line_starts = true;
        } else if (rest[0] == '"') {
            size_t end = end_of_literal(code, at);
            if (end < code.size() && code[end] == '"') literal(at, end);
            at = end + 1;
        } else {
            ++at;
        }
    }
}

}  // namespace

std::vector<LiteralRange> string_literals(std::string_view code) {
    std::vector<LiteralRange> ranges;
    scan(
        code,
        [&](size_t open, size_t close) {
            ranges.push_back({open + 1, close});
        },
        [](size_t) {});
    return ranges;
}

std::vector<IncludeLine> include_lines(std::string_view code) {
    std::vector<IncludeLine> lines;
    auto add = [&](size_t hash) {
        size_t open = code.find_first_of("\"<\n", hash);
        if (open == code.npos || code[open] != '"') return;
        size_t close = code.find_first_of("\"\n", open + 1);
        if (close == code.npos || code[close] != '"') return;
        lines.push_back({{hash, close + 1}, {open + 1, close}});
    };
    scan(
        code, [](size_t, size_t) {}, add);
    return lines;
}

bool may_name_file(std::string_view name) {
    return name.find_first_of("./") != name.npos && name.find_first_of("\\:") == name.npos &&
           !name.starts_with('/');
}

FileLink link_from(const std::string& document) {
    auto folder_of = [](const fs::path& path) {
        std::error_code error;
        return fs::weakly_canonical(fs::absolute(path, error).parent_path(), error);
    };
    return [=](const std::string& name) {
        fs::path file = name;
        return (folder_of(file) / file.filename())
            .lexically_relative(folder_of(document))
            .generic_string();
    };
}

std::string relinked_code(const std::string& code, const AllowedPaths& files,
                          const FileLink& link) {
    std::error_code error;
    std::string result;
    size_t done = 0;
    for (LiteralRange range : string_literals(code)) {
        std::string_view name = std::string_view(code).substr(range.begin, range.end - range.begin);
        if (!may_name_file(name)) continue;
        std::string file = files.find(name).path;
        if (!fs::is_regular_file(file, error)) continue;
        result += code.substr(done, range.begin - done) + link(file);
        done = range.end;
    }
    return result + code.substr(done);
}

}  // namespace kinora
