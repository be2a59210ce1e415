// runtime/programs/convert_document.cpp: .dae to canonical .dae: through the Document, nothing
// lost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/matrix.hpp>
#include <set>

#include "collada/edit.h"
#include "collada/open_scene.h"
#include "collada/write.h"
#include "runtime/findings.h"
#include "runtime/programs/convert.h"

namespace kinora {

namespace fs = std::filesystem;
using collada::Document;
using collada::Edit;
using collada::Element;

namespace {

template <class F>
void for_each_element(const Element& root, F&& f) {
    f(root);
    for (const Element& child : root.children()) for_each_element(child, f);
}

std::string_view trimmed(std::string_view text) {
    size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
}

// A file's relative name, as a link writes it; nothing where it is none of ours to move.
std::optional<std::string> relative_file(std::string_view link) {
    std::string_view name = trimmed(link.substr(0, link.find('#')));
    if (name.empty() || name[0] == '/' || name[0] == '\\' || name.find(':') != name.npos)
        return std::nullopt;
    std::string decoded;
    for (size_t i = 0; i < name.size(); ++i) {
        auto digit = [&](size_t at) {
            return at < name.size() && std::isxdigit(uint8_t(name[at]));
        };
        if (name[i] == '%' && digit(i + 1) && digit(i + 2)) {
            decoded += char(std::stoi(std::string(name.substr(i + 1, 2)), nullptr, 16));
            i += 2;
        } else {
            decoded += name[i] == '\\' ? '/' : name[i];
        }
    }
    return decoded;
}

std::string encoded(const std::string& name) {
    std::string link;
    for (char c : name)
        link += uint8_t(c) <= ' ' || std::string_view("%#?\"<>").find(c) != std::string_view::npos
                    ? fmt::format("%{:02X}", uint8_t(c))
                    : std::string(1, c);
    return link;
}

Edit replace_text(const Element& e, const std::string& text, std::string_view original) {
    uint32_t end = uint32_t(original.rfind("</", e.bytes.end - 1));
    return {{e.start_tag.end, end}, collada::escape_text(text)};
}

constexpr const char* kAxisNames[] = {"X_UP", "Y_UP", "Z_UP"};

// As collada's reader has it (COLLADA 1.4.1, chapter 5, up_axis).
dmat4 y_up_from(UpAxis up) {
    if (up == UpAxis::X) return dmat4({0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1});
    if (up == UpAxis::Z) return dmat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1});
    return dmat4(1.0);
}

std::string matrix_text(const dmat4& m) {
    std::string text = "<matrix>";
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
            text += (r || c ? " " : "") + collada::shortest_number(m[c][r] == 0 ? 0.0 : m[c][r]);
    return text + "</matrix>";
}

bool is_identity_text(std::string_view text) {
    static constexpr double kIdentity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    std::string copy(text);
    char* at = copy.data();
    for (double want : kIdentity)
        if (!(std::abs(std::strtod(at, &at) - want) <= 1e-9)) return false;
    return true;
}

// The edits that give a document other axes and another unit.
class AxisChange {
  public:
    AxisChange(const Document& document, std::string_view text, Diagnostics& diag)
        : document_(document), text_(text), diag_(diag) {}

    std::string run(std::optional<UpAxis> up_axis, std::optional<double> meter) {
        read_asset();
        UpAxis new_up = up_axis.value_or(old_up_);
        double new_meter = meter.value_or(old_meter_);
        write_asset(new_up, new_meter);
        scale_ = old_meter_ / new_meter;
        matrix_ = glm::transpose(y_up_from(new_up)) * y_up_from(old_up_);
        if (new_up == old_up_ && scale_ == 1) return collada::apply_edits(text_, edits_);
        for (int c = 0; c < 3; ++c) matrix_[c] = matrix_[c] * scale_;
        for_each_element(document_.root(), [this](const Element& e) { visit(e); });
        warn();
        return collada::apply_edits(text_, edits_);
    }

  private:
    void read_asset() {
        asset_ = document_.root().child("asset");
        const Element* up = asset_ ? asset_->child("up_axis") : nullptr;
        const Element* unit = asset_ ? asset_->child("unit") : nullptr;
        for (size_t i = 0; up && i < 3; ++i)
            if (trimmed(up->text) == kAxisNames[i]) old_up_ = UpAxis(i);
        if (!unit || !unit->attribute("meter")) return;
        double meter = std::strtod(std::string(unit->value("meter")).c_str(), nullptr);
        if (meter > 0 && std::isfinite(meter)) old_meter_ = meter;
    }

    void write_asset(UpAxis up, double meter) {
        std::string unit = collada::shortest_number(meter);
        std::string unit_markup = fmt::format("<unit meter=\"{}\"{}/>", unit, unit_name(meter));
        std::string up_markup = fmt::format("<up_axis>{}</up_axis>", kAxisNames[size_t(up)]);
        if (!asset_) {
            uint32_t at = document_.root().start_tag.end;
            edits_.push_back({{at, at}, "<asset>" + unit_markup + up_markup + "</asset>"});
            return;
        }
        // <unit> and <up_axis> stand at the end of <asset>, before what 1.5 added.
        uint32_t end = uint32_t(text_.rfind("</", asset_->bytes.end - 1));
        for (const char* later : {"coverage", "extra"})
            if (const Element* e = asset_->child(later)) end = std::min(end, e->bytes.begin);
        const Element* old_unit = asset_->child("unit");
        const Element* old_up = asset_->child("up_axis");
        if (asset_->bytes.end == asset_->start_tag.end) {
            edits_.push_back(collada::append_child(text_, *asset_, unit_markup + up_markup));
            return;
        }
        auto place = [&](const Element* old) {
            return old ? old->bytes : collada::ByteRange{end, end};
        };
        collada::ByteRange unit_place = place(old_unit);
        if (!old_unit && old_up) unit_place = {old_up->bytes.begin, old_up->bytes.begin};
        edits_.push_back({unit_place, unit_markup});
        edits_.push_back({place(old_up), up_markup});
    }

    static std::string unit_name(double meter) {
        static constexpr std::pair<double, const char*> kNames[] = {
            {1, "meter"},        {0.01, "centimeter"}, {0.001, "millimeter"},
            {1000, "kilometer"}, {0.0254, "inch"},     {0.3048, "foot"}};
        for (auto [value, name] : kNames)
            if (value == meter) return fmt::format(" name=\"{}\"", name);
        return "";
    }

    void visit(const Element& e) {
        if (e.name == "visual_scene") return wrap_nodes(e);
        if (e.name == "instance_controller") return keep_skin(e);
        has_rsl_ |= e.name == "profile_RSL";
        // An included file may say anything; code in the document says it here.
        knows_world_ |= (e.name == "code" && e.text.find("\"world\"") != e.text.npos) ||
                        (e.name == "include" && e.parent->name == "technique");
        if (std::string_view url = e.value("url"); url.find('#') != url.npos && url[0] != '#')
            external_ = external_ ? external_ : &e;
        // Lengths that no node's matrix reaches (it does reach the range a camera clips to).
        struct Row {
            std::string_view name;
            double power;
        };
        static constexpr Row kLengths[] = {
            {"xmag", 1}, {"ymag", 1}, {"linear_attenuation", -1}, {"quadratic_attenuation", -2}};
        if (scale_ == 1) return;
        for (const Row& row : kLengths) {
            if (e.name != row.name || !collada::holds_numbers(e)) continue;
            double value = std::strtod(std::string(trimmed(e.text)).c_str(), nullptr);
            edits_.push_back(replace_text(
                e, collada::shortest_number(value * std::pow(scale_, row.power)), text_));
            if (!e.value("sid").empty()) length_sids_.insert(std::string(e.value("sid")));
        }
    }

    void wrap_nodes(const Element& scene) {
        const Element* first = scene.child("node");
        if (!first) return;
        const Element* last = first;
        for (const Element* e = first; e; e = e->next_named("node")) last = e;
        std::string id = "axes_and_unit";
        while (document_.find(id) || !made_ids_.insert(id).second) id += "_";
        edits_.push_back({{first->bytes.begin, first->bytes.begin},
                          fmt::format("<node id=\"{}\">{}", id, matrix_text(matrix_))});
        edits_.push_back({{last->bytes.end, last->bytes.end}, "</node>"});
    }

    // Skins without a bind shape are moved by the matrix of their node, too (COLLADA.md, skins): a
    // child node takes the change off again.
    void keep_skin(const Element& instance) {
        std::string_view url = instance.value("url");
        if (url.empty() || url[0] != '#') return;
        const Element* controller = document_.find(url.substr(1));
        const Element* skin = controller ? controller->child("skin") : nullptr;
        if (!skin) return;
        const Element* shape = skin->child("bind_shape_matrix");
        if (shape && !is_identity_text(shape->text)) return;
        const Element& node = *instance.parent;
        if (node.name != "node") return;
        uint32_t at = uint32_t(text_.rfind("</", node.bytes.end - 1));
        if (const Element* extra = node.child("extra")) at = extra->bytes.begin;
        std::string markup(
            text_.substr(instance.bytes.begin, instance.bytes.end - instance.bytes.begin));
        edits_.push_back(collada::erase_element(text_, instance));
        edits_.push_back(
            {{at, at}, "<node>" + matrix_text(glm::inverse(matrix_)) + markup + "</node>"});
    }

    void warn() {
        if (external_) diag_.report(Code::CONVERT_EXTERNAL, Location{}, external_->value("url"));
        if (has_rsl_ && scale_ != 1)
            diag_.report(Code::CONVERT_LOST, Location{}, "profile_RSL",
                         "lengths in world units inside shader code");
        if (knows_world_)
            diag_.report(Code::CONVERT_LOST, Location{}, "profile_RSL",
                         "places and directions in \"world\" space inside shader code");
        for_each_element(document_.root(), [this](const Element& e) {
            if (e.name != "channel") return;
            std::string_view target = e.value("target");
            std::string_view sid = target.substr(target.rfind('/') + 1);
            if (length_sids_.count(std::string(sid.substr(0, sid.find_first_of(".(")))))
                diag_.report(Code::CONVERT_LOST, Location{}, fmt::format("channel '{}'", target),
                             "an animated length");
        });
    }

    const Document& document_;
    std::string_view text_;
    Diagnostics& diag_;
    const Element* asset_ = nullptr;
    const Element* external_ = nullptr;
    UpAxis old_up_ = UpAxis::Y;
    double old_meter_ = 1;
    double scale_ = 1;  // old units in new ones
    dmat4 matrix_{1.0};
    bool has_rsl_ = false, knows_world_ = false;
    std::set<std::string> length_sids_, made_ids_;
    std::vector<Edit> edits_;
};

}  // namespace

std::string change_axes(const std::string& path, const std::string& text,
                        std::optional<UpAxis> up_axis, std::optional<double> meter,
                        Diagnostics& diag) {
    Diagnostics quiet;
    std::optional<Document> document = collada::read_document_text(path, text, quiet);
    if (!document || !document->whole()) return text;
    std::string_view own = quiet.files.text(document->file());
    return AxisChange(*document, own, diag).run(up_axis, meter);
}

std::string move_links(const std::string& path, const std::string& text,
                       const std::string& new_path, const std::string& archive, Diagnostics& diag) {
    Diagnostics quiet;
    std::optional<Document> document = collada::read_document_text(path, text, quiet);
    if (!document || !document->whole()) return text;
    std::string_view own = quiet.files.text(document->file());
    std::error_code code;
    fs::path from = fs::weakly_canonical(fs::absolute(path), code).parent_path();
    fs::path to = fs::weakly_canonical(fs::absolute(new_path), code).parent_path();
    if (from == to) return text;
    // Out of an archive everything comes along, into a folder beside the new document.
    fs::path unpacked = fs::path(new_path).stem().string() + "_files";
    if (!archive.empty()) {
        unpacked /= from.lexically_relative(fs::weakly_canonical(archive, code));
        fs::copy(archive, to / (fs::path(new_path).stem().string() + "_files"),
                 fs::copy_options::recursive | fs::copy_options::overwrite_existing, code);
    }
    std::vector<Edit> edits;
    std::set<std::string> outside;
    auto moved = [&](std::string_view link) -> std::optional<std::string> {
        std::optional<std::string> file = relative_file(link);
        if (!file) return std::nullopt;
        fs::path moved_file = archive.empty() ? (from / *file).lexically_relative(to)
                                              : (unpacked / *file).lexically_normal();
        if (moved_file.begin() != moved_file.end() && *moved_file.begin() == "..")
            outside.insert(moved_file.generic_string());
        std::string name = encoded(moved_file.generic_string());
        size_t hash = link.find('#');
        return name + (hash == link.npos ? "" : std::string(link.substr(hash)));
    };
    for_each_element(document->root(), [&](const Element& e) {
        // 1.4 writes the name into <init_from>, 1.5 into its <ref>.
        bool names_file = e.name == "init_from" || e.name == "ref";
        bool in_image = e.parent && (e.parent->name == "image" || e.parent->name == "init_from" ||
                                     e.parent->name == "create_2d");
        if (names_file && in_image && !e.first_child)
            if (auto link = moved(e.text)) edits.push_back(replace_text(e, *link, own));
        for (const collada::Attribute& a : e.attributes) {
            bool link_attribute = a.name == "url" || a.name == "source" || a.name == "target";
            bool external = a.value.find('#') != a.value.npos && a.value[0] != '#';
            bool include = e.name == "include" && a.name == "url";
            if (!(link_attribute && external) && !include) continue;
            if (auto link = moved(a.value))
                edits.push_back({a.value_bytes, collada::escape_attribute(*link)});
        }
    });
    if (!outside.empty())
        diag.report(Code::CONVERT_OUTSIDE, Location{}, outside.size(), *outside.begin());
    return collada::apply_edits(own, std::move(edits));
}

std::optional<std::string> convert_document(const ConvertOptions& options, Diagnostics& diag) {
    std::optional<collada::SceneFile> file = collada::open_scene(options.input, diag);
    if (!file) return std::nullopt;
    std::optional<Document> document = collada::read_document(file->document, diag);
    if (!document || !document->whole()) return std::nullopt;  // an Error says why
    std::string path = document->path();
    std::string text = move_links(path, std::string(diag.files.text(document->file())),
                                  options.output, file->folder, diag);
    for (const auto& [material, shader] : options.shaders) {
        std::optional<std::string> next = embed_shader(path, text, material, shader, options, diag);
        if (!next) return std::nullopt;
        text = std::move(*next);
    }
    if (options.up_axis || options.meter)
        text = change_axes(path, text, options.up_axis, options.meter, diag);
    Diagnostics again;
    std::optional<Document> result = collada::read_document_text(options.output, text, again);
    if (!result || !result->whole()) {
        for (const Finding& f : again.findings()) diag.add(*f.info, {}, f.message);
        return std::nullopt;
    }
    return collada::write(*result, again.files);
}

}  // namespace kinora
