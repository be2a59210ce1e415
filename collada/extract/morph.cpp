// collada/extract/morph.cpp: <morph>: target meshes and their weights.
#include <cmath>

#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

Link morph_source(Extraction& x, Link link, std::string_view semantic, const Morph& morph) {
    const Element* targets = link.element->child("targets");
    const Element* input = targets ? find_input(*targets, semantic) : nullptr;
    if (input) return resolve(x, {link.doc, input}, "source", {"source"});
    x.diag.report(Code::MORPH_INPUT, morph.where, morph.id, semantic);
    return {};
}

MorphMethod read_method(Extraction& x, Link link) {
    std::string_view method = link.element->value("method");
    if (method == "RELATIVE") return MorphMethod::Relative;
    if (!method.empty() && method != "NORMALIZED")
        x.diag.report(Code::MORPH_METHOD, x.where(link, "method"), method);
    return MorphMethod::Normalized;
}

bool is_direction(std::string_view semantic) {
    return semantic == "NORMAL" || semantic == "TANGENT" || semantic == "BINORMAL";
}

// A target whose own <asset> has another unit or up axis: the same in those of its base.
uint32_t in_frame_of(Extraction& x, uint32_t target, uint32_t base, Location where) {
    uint32_t frame = x.geometry_frames[base];
    uint32_t conversion = x.frames.conversion(frame, x.geometry_frames[target]);
    if (conversion == kNone) return target;
    auto [known, fresh] = x.converted_geometries.try_emplace({target, frame}, kNone);
    if (!fresh) return known->second;
    const Geometry& from = x.scene.geometries[target];
    uint64_t bytes = sizeof(Geometry) + from.positions.size() * sizeof(dvec3);
    for (const FloatSource& source : from.sources) bytes += source.values.size() * sizeof(float);
    for (const PrimitiveGroup& group : from.groups)
        for (const auto& list : group.indices) bytes += list.size() * sizeof(uint32_t);
    if (!x.budget.reserve(bytes, where)) return kNone;
    const dmat4& matrix = x.scene.conversions[conversion];
    Geometry made = from;
    for (dvec3& p : made.positions) p = dvec3(matrix * dvec4(p, 1.0));
    std::vector<bool> turned(made.sources.size(), false);
    for (const PrimitiveGroup& group : made.groups)
        for (const VertexInput& input : group.inputs) {
            FloatSource& source = made.sources[input.source];
            if (!is_direction(input.semantic) || source.stride != 3 || turned[input.source])
                continue;
            turned[input.source] = true;
            for (size_t i = 0; i + 3 <= source.values.size(); i += 3) {
                float* v = &source.values[i];
                dvec3 d = dmat3(matrix) * dvec3(v[0], v[1], v[2]);
                double length = std::hypot(d.x, d.y, d.z), was = std::hypot(v[0], v[1], v[2]);
                for (int k = 0; k < 3; ++k) v[k] = length > 0 ? float(d[k] * was / length) : v[k];
            }
        }
    x.geometry_frames.push_back(frame);
    return known->second = append(x.scene.geometries, std::move(made));
}

// The geometry of one target with as many positions as the base; kNone (reported) otherwise.
uint32_t read_target(Extraction& x, Link source, std::string_view name, uint32_t base) {
    std::string_view id = name;
    if (id.starts_with('#')) id.remove_prefix(1);
    const Element* element = find_kind(x.document(source.doc), id, {"geometry"});
    if (element) report_ambiguous(x, {source.doc, element}, id, {"geometry"}, x.where(source));
    uint32_t geometry = element ? geometry_index(x, {source.doc, element}) : kNone;
    if (geometry == kNone) {
        x.diag.report(Code::MORPH_TARGET_MISSING, x.where(source), name);
        return kNone;
    }
    size_t has = x.scene.geometries[geometry].positions.size();
    size_t wanted = x.scene.geometries[base].positions.size();
    if (has == wanted) return in_frame_of(x, geometry, base, x.where(source));
    x.diag.report(Code::MORPH_VERTEX_COUNT, x.where(source), name, has, wanted);
    return kNone;
}

void read_targets(Extraction& x, Link link, Morph& morph, std::vector<uint32_t>& remap) {
    Link source = morph_source(x, link, "MORPH_TARGET", morph);
    if (!source) return;
    NameSource names = read_name_source(x, source);
    if (!x.budget.reserve(names.names.size() * 16, x.where(source))) return;
    for (std::string_view name : names.names) {
        uint32_t target = read_target(x, source, name, morph.geometry);
        remap.push_back(target == kNone ? kNone : uint32_t(morph.targets.size()));
        if (target != kNone) morph.targets.push_back(target);
    }
}

void read_weights(Extraction& x, Link link, Morph& morph, uint32_t number,
                  const std::vector<uint32_t>& remap) {
    morph.weights.assign(morph.targets.size(), 0.0);
    morph.weights_where = morph.where;
    Link source = morph_source(x, link, "MORPH_WEIGHT", morph);
    if (!source) return;
    std::vector<double> weights = read_double_source(x, source).values;
    if (weights.size() != remap.size())
        x.diag.report(Code::MORPH_WEIGHT_COUNT, x.where(source), weights.size(), remap.size());
    for (size_t i = 0; i < std::min(weights.size(), remap.size()); ++i)
        if (remap[i] != kNone && std::isfinite(weights[i])) morph.weights[remap[i]] = weights[i];
    morph.weights_where = x.where(source);
    TargetRef ref{Owner::MorphWeight, number, 0, 0, uint32_t(remap.size())};
    x.target_of.emplace(source.element, ref);
    if (const Element* array = source.element->child("float_array"))
        x.target_of.emplace(array, ref);
}

// What the morph changes: a mesh, another morph's result, or the mesh of a skin. A skin's joints
// move what all its morphs make of its mesh: targets are shapes in the pose of the bind, and
// weights mean nothing between that and another pose.
void read_base(Extraction& x, Link base, Morph& morph) {
    if (base.element->name == "geometry") {
        morph.geometry = geometry_index(x, base);
    } else if (base.element->child("skin")) {
        morph.skin = skin_index(x, base);
        if (morph.skin == kNone) return;
        morph.geometry = x.scene.skins[morph.skin].geometry;
        morph.base = x.scene.skins[morph.skin].morph;
    } else if (base.element->child("morph")) {
        morph.base = morph_index(x, base);
        if (morph.base == kNone) return;
        morph.geometry = x.scene.morphs[morph.base].geometry;
        morph.skin = x.scene.morphs[morph.base].skin;
    }
}

}  // namespace

bool ControllerDepth::fits(Link controller) const {
    constexpr int kMost = 16;
    if (x_.controller_depth <= kMost) return true;
    x_.diag.report(Code::MORPH_DEPTH, x_.where(controller), controller.element->value("id"), kMost);
    return false;
}

uint32_t morph_index(Extraction& x, Link link) {
    auto [at, fresh] = x.made.emplace(link.element, kNone);
    if (!fresh) return at->second;
    uint32_t& result = at->second;
    ControllerDepth depth(x);
    if (!depth.fits(link)) return result;
    Link element{link.doc, link.element->child("morph")};
    Morph morph;
    morph.id = link.element->value("id");
    morph.where = x.where(link);
    morph.method = read_method(x, element);
    Link base = resolve(x, element, "source", {"geometry", "controller"});
    if (!base || !x.budget.reserve(sizeof(Morph), morph.where)) return result;
    read_base(x, base, morph);
    if (morph.geometry == kNone) {
        x.diag.report(Code::MORPH_SOURCE, x.where(element, "source"), morph.id);
        return result;
    }
    std::vector<uint32_t> remap;
    read_targets(x, element, morph, remap);
    uint32_t number = uint32_t(x.scene.morphs.size());
    read_weights(x, element, morph, number, remap);
    if (morph.targets.empty()) x.diag.report(Code::MORPH_EMPTY, morph.where, morph.id);
    if (morph.targets.size() != remap.size()) x.morph_remap[number] = std::move(remap);
    x.scene.morphs.push_back(std::move(morph));
    return result = number;
}

}  // namespace kinora::collada
