// runtime/description/rsl_literals.cpp: string literals of RSL code that name files.
#include "runtime/description/rsl_literals.h"

#include <algorithm>
#include <filesystem>

namespace kinora {

namespace fs = std::filesystem;

std::vector<LiteralRange> string_literals(std::string_view code) {
    std::vector<LiteralRange> ranges;
    bool line_starts = true;
    auto end_of = [&](std::string_view end, size_t from) {
        size_t found = code.find(end, from);
        return found == code.npos ? code.size() : found + end.size();
    };
    for (size_t at = 0; at < code.size();) {
        std::string_view rest = code.substr(at);
        bool starts_line = line_starts;
        line_starts = rest[0] == '\n' || (starts_line && (rest[0] == ' ' || rest[0] == '\t'));
        if (rest.starts_with("//")) {
            at = end_of("\n", at);
            line_starts = true;
        } else if (rest.starts_with("/*")) {
            at = end_of("*/", at + 2);
        } else if (rest[0] == '#' && starts_line) {
            size_t word = code.find_first_not_of(" \t", at + 1);
            bool include = word != code.npos && code.substr(word).starts_with("include");
            at = include ? end_of("\n", at) : at + 1;
            line_starts = include;
        } else if (rest[0] == '"') {
            size_t end = at + 1;
            while (end < code.size() && code[end] != '"' && code[end] != '\n')
                end += code[end] == '\\' ? 2 : 1;
            if (end < code.size() && code[end] == '"') ranges.push_back({at + 1, end});
            at = end + 1;
        } else {
            ++at;
        }
    }
    return ranges;
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
