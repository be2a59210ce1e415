// runtime/player/files/shader_source.cpp: <code> elements and .sl files, byte by byte.
#include "runtime/player/files/shader_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "runtime/base/files/temporary_file.h"
#include "runtime/scene/description/shader_library.h"

namespace kinora {

namespace {

constexpr std::string_view kOpen = "<![CDATA[", kClose = "]]>";

struct Entity {
    std::string_view written;
    char meant;
};
constexpr Entity kEntities[] = {
    {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}};

// The character that stands at the beginning of `xml`, and how long it is written.
std::pair<char, size_t> next_character(std::string_view xml) {
    for (const Entity& entity : kEntities)
        if (xml.starts_with(entity.written)) return {entity.meant, entity.written.size()};
    if (xml.starts_with("\r\n")) return {'\n', 2};
    return {xml.front() == '\r' ? '\n' : xml.front(), 1};
}

size_t count(std::string_view text, std::string_view word) {
    size_t n = 0;
    for (size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++n;
    return n;
}

bool is_xml(std::string_view text) {
    std::string_view head = text.substr(0, 4096);
    return head.find("<COLLADA") != head.npos || head.find("<?xml") != head.npos;
}

// The element around `at`: from behind its tag to before its end.
std::optional<std::pair<size_t, size_t>> element_around(std::string_view xml, size_t at,
                                                        std::string_view name) {
    size_t begin = xml.rfind("<" + std::string(name), at);
    if (begin == xml.npos) return std::nullopt;
    begin = xml.find('>', begin);
    size_t end = xml.find("</" + std::string(name), at);
    if (begin == xml.npos || end == xml.npos || begin >= at) return std::nullopt;
    return std::pair(begin + 1, end);
}

void take_embedded(std::string_view xml, size_t at, ShaderSourceText& source) {
    source.embedded = true;
    auto code = element_around(xml, at, "code");
    if (!code) {
        source.why_fixed = "its <code> was not found";
        return;
    }
    source.begin = uint32_t(code->first);
    source.end = uint32_t(code->second);
    source.text = plain_text(xml.substr(code->first, code->second - code->first), source.cdata);
    auto profile = element_around(xml, at, "profile_RSL");
    std::string_view around =
        profile ? xml.substr(profile->first, profile->second - profile->first) : "";
    if (count(around, "<code") != 1 || count(around, "<include") != 0)
        source.why_fixed = "its effect has several texts";
}

// Of the tag that begins there; "" if it has none of that name.
std::string attribute(std::string_view xml, size_t tag, std::string_view name) {
    if (tag >= xml.size()) return "";
    std::string_view inside = xml.substr(tag, xml.find('>', tag) - tag);
    const std::string wanted = std::string(name) + "=";
    for (size_t at = inside.find(wanted); at != inside.npos; at = inside.find(wanted, at + 1)) {
        const size_t begin = at + wanted.size();
        const bool whole =
            at > 0 && std::string_view(" \t\r\n").find(inside[at - 1]) != inside.npos;
        if (!whole || begin >= inside.size()) continue;
        const size_t end = inside.find(inside[begin], begin + 1);
        if (end != inside.npos) return std::string(inside.substr(begin + 1, end - begin - 1));
    }
    return "";
}

// What is read of a file; saving compares the text itself.
bool may_hold(const std::string& file, std::string_view bytes) {
    constexpr size_t kLooked = 4096;
    std::error_code error;
    if (std::filesystem::file_size(file, error) != bytes.size() || error) return false;
    std::string begin(std::min(bytes.size(), kLooked), 0);
    std::ifstream in(file, std::ios::binary);
    return in.read(begin.data(), std::streamsize(begin.size())) && bytes.starts_with(begin);
}

}  // namespace

TextRange text_range(const rsl::Shader& shader, const SourceFiles& files) {
    const Location where = shader.definition ? shader.definition->span.where : Location{};
    if (where.file >= files.count()) return {};
    const std::string_view text = files.text(where.file);
    if (text == library_shader_text(shader.name)) return {};  // others may have its name
    if (!is_xml(text)) return {where.file, 0, text.size()};
    const auto code = element_around(text, where.begin, "code");
    return code ? TextRange{where.file, code->first, code->second} : TextRange{};
}

std::string xml_text(const std::string& text, bool cdata) {
    std::string out(cdata ? kOpen : "");
    for (size_t k = 0; k < text.size(); ++k) {
        std::string_view rest = std::string_view(text).substr(k);
        if (cdata && rest.starts_with(kClose)) {  // one section cannot hold it
            out += "]]]]><![CDATA[>";
            k += 2;
        } else if (!cdata && (text[k] == '<' || text[k] == '&')) {
            out += text[k] == '<' ? "&lt;" : "&amp;";
        } else if (!cdata && rest.starts_with(kClose)) {
            out += "]]&gt;";
            k += 2;
        } else {
            out += text[k];
        }
    }
    return out + std::string(cdata ? kClose : "");
}

std::string plain_text(std::string_view xml, bool& cdata) {
    std::string out;
    cdata = xml.find(kOpen) != xml.npos;
    while (!xml.empty()) {
        if (xml.starts_with(kOpen)) {
            size_t end = std::min(xml.find(kClose), xml.size());
            for (size_t k = kOpen.size(); k < end; ++k) {
                if (xml[k] == '\r' && k + 1 < end && xml[k + 1] == '\n') continue;
                out += xml[k] == '\r' ? '\n' : xml[k];
            }
            xml.remove_prefix(std::min(end + kClose.size(), xml.size()));
            continue;
        }
        auto [meant, length] = next_character(xml);
        out += meant;
        xml.remove_prefix(length);
    }
    return out;
}

ShaderSourceText source_of(const rsl::Shader& shader, const SourceFiles& files) {
    ShaderSourceText source;
    source.name = shader.name + ".sl";
    Location where = shader.definition ? shader.definition->span.where : Location{};
    std::string_view ours = library_shader_text(shader.name);
    std::string file = where.file < files.count() ? files.name(where.file) : "";
    std::string_view text = where.file < files.count() ? files.text(where.file) : "";
    bool readable = !file.empty() && may_hold(file, text);
    if (!readable && !ours.empty()) {
        source.text = ours;
        source.why_fixed = "it is one of ours: save it with a file's name";
        return source;
    }
    source.file = file;
    if (!readable) source.why_fixed = "its file is not there, or is packed in another";
    if (is_xml(text)) {
        source.name = file + ":" + source.name;
        take_embedded(text, where.begin, source);
        return source;
    }
    source.name = file;
    source.text = text;
    source.end = uint32_t(text.size());
    return source;
}

void add_broken_shaders(const SourceFiles& files, Location error, std::vector<BrokenShader>& to) {
    std::string_view xml = files.text(error.file);
    if (xml.substr(0, 4096).find("<COLLADA") == xml.npos) return;
    auto code = element_around(xml, error.begin, "code");
    auto effect = element_around(xml, error.begin, "effect");
    if (!code || !effect) return;
    const std::string wanted = "#" + attribute(xml, xml.rfind('<', effect->first - 1), "id");
    for (size_t at = xml.find("<material "); at != xml.npos; at = xml.find("<material ", at + 1)) {
        const std::string id = attribute(xml, at, "id");
        std::string_view body = xml.substr(at, xml.find("</material", at) - at);
        const size_t instance = body.find("<instance_effect");
        if (instance == body.npos || attribute(body, instance, "url") != wanted) continue;
        if (std::ranges::any_of(to, [&](const BrokenShader& b) { return b.material == id; }))
            continue;
        BrokenShader& broken = to.emplace_back();
        broken.material = id;
        broken.source.file = files.name(error.file);
        broken.source.name = broken.source.file + ":" + id + ".sl";
        take_embedded(xml, error.begin, broken.source);
        if (!may_hold(broken.source.file, xml))
            broken.source.why_fixed = "its file is not there, or is packed in another";
    }
}

std::string save_source(const ShaderSourceText& source, const std::string& text) {
    if (!source.why_fixed.empty()) return source.why_fixed;
    std::string bytes;
    {
        std::ifstream in(source.file, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
        if (!in) return std::strerror(errno);
    }
    bool cdata = false;
    std::string_view now = std::string_view(bytes).substr(
        std::min<size_t>(source.begin, bytes.size()), source.end - source.begin);
    if ((source.embedded ? plain_text(now, cdata) : std::string(now)) != source.text)
        return "the file has changed since it was read";
    bytes.replace(source.begin, source.end - source.begin,
                  source.embedded ? xml_text(text, source.cdata) : text);
    const int number = replace_file(source.file, bytes);
    return number ? std::strerror(number) : "";
}

}  // namespace kinora
