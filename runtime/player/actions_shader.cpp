// runtime/player/actions_shader.cpp: the shader that is edited while it is shown.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

#include "runtime/player/core_p.h"
#include "runtime/scene/description/shader_library.h"

namespace kinora {

namespace {

const std::vector<std::string> kNoWords;

CommandResult no_text() {
    return refused("no shader is being edited; select a material and say edit");
}

const MaterialInfo* material_of(const PlayerCore& core, const std::string& id) {
    if (!core.info) return nullptr;
    auto found = std::ranges::find_if(core.info->materials,
                                      [&](const MaterialInfo& m) { return m.id == id; });
    return found == core.info->materials.end() ? nullptr : &*found;
}

const SceneEdits::Text* text_of(const SceneEdits& edits, const std::string& id) {
    auto found = std::ranges::find(edits.texts, id, &SceneEdits::Text::material);
    return found == edits.texts.end() ? nullptr : &*found;
}

bool is_alone(const SceneEdits& edits, const std::string& id) {
    const SceneEdits::Text* text = text_of(edits, id);
    return text && text->alone;
}

// The first of those that wear the text; itself, where it wears one alone.
std::string wearer_of(const PlayerCore& core, const MaterialInfo& material) {
    const ShaderSourceText& own = *material.source;
    if (own.file.empty() || is_alone(core.edits, material.id)) return material.id;
    for (const MaterialInfo& other : core.info->materials) {
        const ShaderSourceText* source = other.source.get();
        if (source && source->file == own.file && source->begin == own.begin &&
            source->end == own.end && !is_alone(core.edits, other.id))
            return other.id;
    }
    return material.id;
}

// The new text is shown as soon as it compiles. Letters typed one after the other are one change.
void show_text(PlayerCore& core, std::string text, bool typed) {
    ShaderDocument& document = core.document;
    document.text = std::move(text);
    document.caret = std::min(document.caret, document.text.size());
    ++document.version;
    document.compiling = true;
    document.dirty = true;
    SceneEdits edits = core.edits;
    auto found = std::ranges::find_if(
        edits.texts, [&](const SceneEdits::Text& t) { return t.material == document.wearer; });
    if (found == edits.texts.end())
        found = edits.texts.insert(edits.texts.end(), {document.wearer, document.name, "", 0});
    found->text = document.text;
    found->version = document.version;
    if (typed && core.typing) {
        core.edits = std::move(edits);
        core.rebuild();
    } else {
        core.change_scene(std::move(edits));
    }
    core.typing = typed;
}

size_t offset_of(const std::string& text, int line, int column) {
    size_t at = 0;
    for (int k = 1; k < line; ++k) {
        size_t end = text.find('\n', at);
        if (end == text.npos) return text.size();
        at = end + 1;
    }
    size_t end = std::min(text.find('\n', at), text.size());
    return std::min(at + size_t(std::max(column, 1) - 1), end);
}

// A text of a shader, and where in it a finding stands.
struct PlaceInText {
    std::string material;
    size_t at = 0;
};

// How far into the decoded text a byte of the file is that the text stands in.
size_t decoded_offset(const ShaderSourceText& source, uint32_t byte) {
    std::ifstream in(source.file, std::ios::binary);
    std::string head(byte, 0);
    if (!in.read(head.data(), std::streamsize(head.size()))) return 0;
    bool cdata = false;
    return plain_text(std::string_view(head).substr(source.begin), cdata).size();
}

std::optional<PlaceInText> place_in_text(const PlayerCore& core, const FindingText& finding) {
    const ShaderDocument& document = core.document;
    if (!document.material.empty() && finding.file == document.name)
        return PlaceInText{document.material, finding.begin};
    if (!core.info || finding.file.empty()) return std::nullopt;
    for (const MaterialInfo& material : core.info->materials) {
        const ShaderSourceText* source = material.source.get();
        if (!source) continue;
        if (finding.file == source->name) return PlaceInText{material.id, finding.begin};
        if (!source->embedded || finding.file != source->file) continue;
        if (finding.begin >= source->begin && finding.begin <= source->end)
            return PlaceInText{material.id, decoded_offset(*source, finding.begin)};
    }
    return std::nullopt;
}

bool is_trailing(char c) {  // of a character of several bytes
    return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

}  // namespace

CommandResult action_edit(PlayerCore& core, const Arguments& a) {
    std::string id = core.state.selection.material;
    if (id.empty() && core.info && !core.info->materials.empty())
        id = core.info->materials.front().id;
    const MaterialInfo* material = material_of(core, id);
    if (!material || !material->source) return refused("no material with a shader is selected");
    core.typing = false;
    if (core.document.material != id) {
        ShaderDocument document;
        document.version = core.document.version;
        document.material = id;
        document.wearer = wearer_of(core, *material);
        document.file = material->source->file;
        document.name = material->source->name;
        document.embedded = material->source->embedded;
        document.text = material->source->text;
        document.params = material->params;
        if (!text_of(core.edits, document.wearer) && text_of(core.edits, id))
            document.wearer = id;  // a session says so
        if (const SceneEdits::Text* edited = text_of(core.edits, document.wearer)) {
            document.text = edited->text;
            document.name = edited->file;
        }
        document.dirty = document.text != material->source->text;
        core.document = std::move(document);
    }
    core.show_panel("editor");
    if (!a.has(0)) return {};
    std::ifstream in(a.text(0), std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    if (!in) return refused(fmt::format("'{}': {}", a.text(0), std::strerror(errno)), 1);
    show_text(core, std::move(text), false);
    return {};
}

CommandResult action_bind(PlayerCore& core, const Arguments& a) {
    if (core.state.selection.material.empty()) return refused("no material is selected");
    const std::vector<std::string> ours = shaders_to_choose();
    const std::string name = a.text(0);
    if (std::ranges::find(ours, name) == ours.end())
        return refused(unknown_name("shader of ours", name, ours), 1);
    if (CommandResult opened = action_edit(core, Arguments(kNoWords)); !opened.done) return opened;
    ShaderDocument& document = core.document;
    document.wearer = document.material;
    document.text = library_shader_text(name);
    document.caret = 0;
    document.dirty = true;
    document.compiling = true;
    ++document.version;
    core.typing = false;
    core.change_scene(edits_with_text(
        core.edits, {document.material, document.name, document.text, document.version, true}));
    return {};
}

CommandResult action_set_text(PlayerCore& core, const Arguments& a) {
    if (core.document.material.empty()) return no_text();
    show_text(core, a.text(0), true);
    return {};
}

CommandResult action_type(PlayerCore& core, const Arguments& a) {
    ShaderDocument& document = core.document;
    if (document.material.empty()) return no_text();
    std::string text = document.text;
    size_t caret = document.caret;
    text.insert(caret, a.text(0));
    show_text(core, std::move(text), true);
    document.caret = caret + a.text(0).size();
    return {};
}

CommandResult action_erase(PlayerCore& core, const Arguments& a) {
    ShaderDocument& document = core.document;
    if (document.material.empty()) return no_text();
    std::string text = document.text;
    size_t begin = document.caret, end = begin;
    int count = a.has(0) ? int(std::clamp(a.number(0), -1e6, 1e6)) : -1;
    for (; count < 0 && begin > 0; ++count) do
            --begin;
        while (begin > 0 && is_trailing(text[begin]));
    for (; count > 0 && end < text.size(); --count) do
            ++end;
        while (end < text.size() && is_trailing(text[end]));
    text.erase(begin, end - begin);
    document.caret = begin;
    show_text(core, std::move(text), true);
    return {};
}

CommandResult action_caret(PlayerCore& core, const Arguments& a) {
    ShaderDocument& document = core.document;
    if (document.material.empty()) return no_text();
    document.caret = offset_of(document.text, int(std::clamp(a.number(0), 1.0, 1e9)),
                               int(std::clamp(a.number(1), 1.0, 1e9)));
    core.typing = false;
    return {};
}

CommandResult action_find(PlayerCore& core, const Arguments& a) {
    ShaderDocument& document = core.document;
    if (document.material.empty()) return no_text();
    size_t from = std::min(document.caret + 1, document.text.size());
    size_t at = document.text.find(a.text(0), from);
    if (at == std::string::npos) at = document.text.find(a.text(0));
    if (at == std::string::npos)
        return refused(fmt::format("the shader has no '{}'", a.text(0)), 1);
    document.caret = at;
    core.typing = false;
    return {};
}

// Into the editor where a shader's text is at fault, else to the file.
CommandResult action_finding(PlayerCore& core, const Arguments& a) {
    const std::vector<FindingText>& all = core.all_findings;
    if (all.empty()) return refused("nothing was found: neither an error nor a warning");
    if (a.has(0) && !(a.number(0) >= 1 && a.number(0) <= double(all.size())))
        return refused(fmt::format("there are findings 1 to {}", all.size()), 1);
    size_t& number = core.state.finding;
    number = a.has(0) ? size_t(a.number(0)) : number % all.size() + 1;
    if (number > all.size()) number = 1;
    const FindingText finding = all[number - 1];
    if (std::optional<PlaceInText> place = place_in_text(core, finding)) {
        const std::string before = std::exchange(core.state.selection.material, place->material);
        if (action_edit(core, Arguments(kNoWords)).done) {
            core.document.caret = std::min(place->at, core.document.text.size());
            core.show_panel("editor");
            return {true, finding.message, 0};
        }
        core.state.selection.material = before;
    }
    if (finding.file.empty()) return {true, finding.message, 0};
    core.state.place = {finding.file, finding.line, finding.column, finding.printed};
    core.show_panel("source");
    return {true, finding.message, 0};
}

CommandResult action_save(PlayerCore& core, const Arguments& a) {
    ShaderDocument& document = core.document;
    if (document.material.empty()) return no_text();
    const MaterialInfo* material = material_of(core, document.material);
    if (!material || !material->source) return no_text();
    std::string file = a.text_or(0, document.file), error;
    if (a.has(0)) {
        std::ofstream out(file, std::ios::binary);
        out << document.text;
        if (!out.flush()) error = std::strerror(errno);
    } else {
        error = save_source(*material->source, document.text);
    }
    if (!error.empty())
        return refused(fmt::format("'{}' is not saved: {}", file, error), a.count());
    ++core.state.files_written;
    document.dirty = false;
    if (a.has(0)) return {true, file, 0};
    // From now on the file says it.
    std::erase_if(core.edits.texts,
                  [&](const SceneEdits::Text& text) { return text.material == document.wearer; });
    core.open_again();
    return {true, file, 0};
}

}  // namespace kinora
