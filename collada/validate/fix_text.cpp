// collada/validate/fix_text.cpp: decimal commas, links without '#', paths.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "collada/document/write.h"
#include "collada/text/numbers_p.h"
#include "collada/validate/fix_p.h"

namespace kinora::collada {

namespace {

void fix_commas_of_word(std::string_view word, uint32_t begin, std::vector<Edit>& edits) {
    double value = 0;
    if (!comma_decimal(word, value)) return;
    uint32_t at = begin + uint32_t(word.find(','));
    edits.push_back({{at, at + 1}, "."});
}

// Also what would be markup in a text or between quotes: & and '.
std::string percent_encode(std::string_view path) {
    constexpr std::string_view kPlain = "-._~/!$()*+,;=@";
    std::string out;
    for (char c : path) {
        bool plain =
            std::isalnum(uint8_t(c)) || uint8_t(c) >= 0x80 || kPlain.find(c) != kPlain.npos;
        out += plain ? std::string(1, c) : fmt::format("%{:02X}", uint8_t(c));
    }
    return out;
}

// What can be said without the file: separators, spaces, file://NAME.
std::string tidy_uri(std::string_view uri) {
    std::string out;
    for (char c : uri) {
        if (c == '\\')
            out += '/';
        else if (c == ' ')
            out += "%20";
        else
            out += c;
    }
    bool absolute = out.starts_with("file:///") || out.starts_with("file://localhost/");
    return out.starts_with("file://") && !absolute ? out.substr(7) : out;
}

// The file that reading found for this image, relative to the document, as a URI; "" if it found
// none below the document's folder or the one above.
std::string found_uri(const FixContext& context, std::string_view uri) {
    if (!context.scene) return {};
    namespace fs = std::filesystem;
    for (const Image& image : context.scene->images) {
        if (image.uri != uri || image.path.empty()) continue;
        const std::string& folder = context.document.directory();
        auto absolute = [](const std::string& path) {
            std::error_code error;
            return fs::absolute(path, error).lexically_normal();
        };
        fs::path relative =
            absolute(image.path).lexically_relative(absolute(folder.empty() ? "." : folder));
        bool far = relative.generic_string().starts_with("../..");
        if (relative.empty() || relative.is_absolute() || far) return {};
        return percent_encode(relative.generic_string());
    }
    return {};
}

std::string_view written(const FixContext& context, Location where) {
    return context.text.substr(where.begin, where.end - where.begin);
}

}  // namespace

void fix_comma_decimals(FixContext& context) {
    for (const Finding* finding : context.findings) {
        const Element& list = context.elements.at(finding->where.begin);
        if (finding->where.begin < list.start_tag.end) {  // an attribute's value
            std::string_view word = trim(written(context, finding->where));
            fix_commas_of_word(word, uint32_t(word.data() - context.text.data()), context.edits);
            continue;
        }
        uint32_t begin = list.start_tag.end;
        std::string_view bytes = context.text.substr(begin, list.bytes.end - begin);
        bytes = bytes.substr(0, bytes.find('<'));  // lists of numbers hold no markup
        for (std::string_view word : split_words(bytes))
            fix_commas_of_word(word, begin + uint32_t(word.data() - bytes.data()), context.edits);
    }
}

// Besides those reported, all attributes that can only be links into this document: readers differ
// in which of them they look at.
void fix_missing_hash(FixContext& context) {
    std::set<uint32_t> offsets;
    for (const Finding* finding : context.findings) {
        if (finding->info == &Code::SCHEMA_PATTERN) continue;  // of anything
        uint32_t at = finding->where.begin;
        while (at < finding->where.end && std::isspace(uint8_t(context.text[at]))) ++at;
        offsets.insert(at);
    }
    for (const Element* element : context.elements.all()) {
        if (in_private_data(*element)) continue;
        const Attribute* source = element->attribute("source");
        bool link = source && (element->name == "input" || element->name == "accessor" ||
                               element->name == "channel");
        if (link && context.document.find(source->value)) offsets.insert(source->value_bytes.begin);
    }
    for (uint32_t at : offsets) context.edits.push_back({{at, at}, "#"});
}

// Its first letter is the axis, however the rest is spelt.
void fix_up_axis(FixContext& context) {
    for (const Finding* finding : context.findings) {
        std::string_view text = written(context, finding->where);
        auto letter = std::find_if(text.begin(), text.end(),
                                   [](char c) { return std::isalpha(uint8_t(c)) != 0; });
        if (letter == text.end()) continue;
        context.edits.push_back({{finding->where.begin, finding->where.end},
                                 fmt::format("{}_UP", char(std::toupper(uint8_t(*letter))))});
    }
}

void fix_path(FixContext& context) {
    for (const Finding* finding : context.findings) {
        std::string_view bytes = written(context, finding->where);
        std::string_view value = trim(bytes);
        // Markup or references inside: not worth the risk.
        if (value.empty() || value.find_first_of("<&") != value.npos) continue;
        std::string uri = found_uri(context, value);
        if (uri.empty()) uri = tidy_uri(value);
        uint32_t begin = finding->where.begin + uint32_t(value.data() - bytes.data());
        if (uri != value) context.edits.push_back({{begin, begin + uint32_t(value.size())}, uri});
    }
}

}  // namespace kinora::collada
