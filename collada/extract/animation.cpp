// collada/extract/animation.cpp: <animation>s become flat channels; clips name ranges of them.
#include "collada/extract/targets_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

// How a sampler's numbers are laid out for its channel.
struct Layout {
    uint32_t keep = 0;       // components kept of each key
    bool transpose = false;  // whole matrices: rows of the file to columns
    bool operator==(const Layout&) const = default;
};

class AnimationReader {
  public:
    explicit AnimationReader(Extraction& x) : x_(x), targets_(x) {}
    void read_document(uint32_t doc);
    void read_clips(uint32_t doc);
    void check_duplicates();
    void resolve_bindings();

  private:
    struct Raw {
        bool usable = false;
        uint32_t stride = 0;
        Sampler sampler;  // moved out by the first channel
        std::vector<std::pair<Layout, uint32_t>> used;
    };
    void read_animation(Link link);
    void read_channel(Link link);
    Raw& raw_sampler(Link link);
    uint32_t sampler_for(Raw& raw, Link link, Layout layout);
    bool fit(const Raw& raw, Link channel, TargetRef& ref, Layout& layout);

    Extraction& x_;
    TargetResolver targets_;
    std::unordered_map<const Element*, Raw> raw_;
    // The channels of an animation and of those nested in it follow one another.
    std::unordered_map<const Element*, std::pair<uint32_t, uint32_t>> channels_of_;
};

void lay_out(std::vector<double>& list, uint32_t stride, uint32_t dims, Layout layout) {
    if (list.empty() || (layout.keep == stride && !layout.transpose)) return;
    size_t keys = list.size() / (size_t(stride) * dims);
    std::vector<double> out;
    out.reserve(keys * layout.keep * dims);
    for (size_t k = 0; k < keys; ++k)
        for (uint32_t c = 0; c < layout.keep; ++c) {
            uint32_t from = layout.transpose ? c % 4 * 4 + c / 4 : c;
            for (uint32_t d = 0; d < dims; ++d) out.push_back(list[(k * stride + from) * dims + d]);
        }
    list = std::move(out);
}

AnimationReader::Raw& AnimationReader::raw_sampler(Link link) {
    auto [at, fresh] = raw_.try_emplace(link.element);
    Raw& raw = at->second;
    if (fresh) {
        raw.usable = read_sampler(x_, link, raw.sampler);
        raw.stride = raw.sampler.stride;
    }
    return raw;
}

uint32_t AnimationReader::sampler_for(Raw& raw, Link link, Layout layout) {
    for (auto& [known, index] : raw.used)
        if (known == layout) return index;
    Sampler sampler;
    if (raw.used.empty()) {
        sampler = std::move(raw.sampler);
    } else {  // another layout of the same keys: read them again, with the findings unheard
        Diagnostics unheard;
        Extraction again(unheard, x_.options);
        again.documents.see(x_.documents);
        again.budget.resume(x_.budget);
        if (!read_sampler(again, link, sampler)) return kNone;
        x_.budget.resume(again.budget);
    }
    uint32_t dims = sampler.tangent_dims;
    lay_out(sampler.values, sampler.stride, 1, layout);
    lay_out(sampler.in_tangents, sampler.stride, dims, layout);
    lay_out(sampler.out_tangents, sampler.stride, dims, layout);
    sampler.stride = layout.keep;
    uint32_t index = append(x_.scene.samplers, std::move(sampler));
    raw.used.push_back({layout, index});
    return index;
}

// Makes target and sampler agree on the number of components.
bool AnimationReader::fit(const Raw& raw, Link channel, TargetRef& ref, Layout& layout) {
    layout.keep = raw.stride;
    layout.transpose = ref.whole_matrix && raw.stride == 16;
    if (raw.stride == ref.count) return true;
    bool color = ref.kind == Owner::Light || ref.kind == Owner::EffectParam ||
                 ref.kind == Owner::MaterialParam;
    if (color && ref.count == 3 && raw.stride == 4) {  // RGBA keys on an RGB colour
        layout.keep = 3;
        return true;
    }
    x_.diag.report(Code::ANIM_STRIDE, x_.where(channel, "target"), channel.element->value("target"),
                   ref.count, raw.stride);
    return false;
}

void AnimationReader::read_channel(Link link) {
    Link source = resolve(x_, link, "source", {"sampler"});
    if (!source) return;
    Raw& raw = raw_sampler(source);
    if (!raw.usable) return;
    std::string_view target = link.element->value("target");
    Channel channel;
    channel.target = target;
    channel.where = x_.where(link, "target");
    channel.ref =
        targets_.resolve(link.doc, target, channel.where, raw.stride, Code::ANIM_TARGET_UNRESOLVED);
    Layout layout;
    if (channel.ref.kind == Owner::None || !fit(raw, link, channel.ref, layout)) return;
    channel.sampler = sampler_for(raw, source, layout);
    if (channel.sampler == kNone) return;
    x_.scene.channels.push_back(std::move(channel));
}

void AnimationReader::read_animation(Link link) {
    uint32_t first = uint32_t(x_.scene.channels.size());
    for (const Element& child : link.element->children()) {
        if (child.name == "channel") read_channel({link.doc, &child});
        if (child.name == "animation") read_animation({link.doc, &child});
        if (child.name == "sampler" && x_.options.everything) raw_sampler({link.doc, &child});
    }
    channels_of_[link.element] = {first, uint32_t(x_.scene.channels.size())};
}

void AnimationReader::read_document(uint32_t doc) {
    for (const Element& library : x_.document(doc).root().children())
        if (library.name == "library_animations")
            for (const Element& child : library.children())
                if (child.name == "animation") read_animation({doc, &child});
}

double clip_time(Extraction& x, Link clip, std::string_view attribute, double missing) {
    const Attribute* a = clip.element->attribute(attribute);
    double value = missing;
    if (a && !parse_double(a->value, value)) {
        x.diag.report(Code::SRC_NUMBER, x.where(clip, attribute), a->value);
        return missing;
    }
    return value;
}

void AnimationReader::read_clips(uint32_t doc) {
    for (const Element& library : x_.document(doc).root().children()) {
        if (library.name != "library_animation_clips") continue;
        for (const Element& element : library.children()) {
            if (element.name != "animation_clip") continue;
            Link link{doc, &element};
            Clip clip;
            clip.id = element.value("id");
            clip.name = element.value("name");
            const Element* own = extra_technique(element, "KINORA");
            if (own && own->child("name")) clip.name = own->child("name")->text;
            clip.where = x_.where(link);
            double last_key = 0;
            for (const Element& child : element.children()) {
                if (child.name != "instance_animation") continue;
                Link animation = resolve(x_, {doc, &child}, "url", {"animation"});
                if (!animation) continue;
                auto [first, end] = channels_of_[animation.element];
                if (!x_.budget.reserve((end - first) * sizeof(uint32_t), clip.where)) continue;
                for (uint32_t c = first; c < end; ++c) {
                    clip.channels.push_back(c);
                    x_.scene.channels[c].in_clip = true;
                    const Sampler& s = x_.scene.samplers[x_.scene.channels[c].sampler];
                    last_key = std::max(last_key, s.times.back());
                }
            }
            clip.start = clip_time(x_, link, "start", 0);
            clip.end = clip_time(x_, link, "end", std::max(last_key, clip.start));
            if (clip.end < clip.start) {
                x_.diag.report(Code::ANIM_CLIP_RANGE, clip.where,
                               clip.id.empty() ? clip.name : clip.id, "ends before it starts");
                std::swap(clip.start, clip.end);
            }
            x_.scene.clips.push_back(std::move(clip));
        }
    }
}

// Clips may well drive the same value; channels that always play may not.
void AnimationReader::check_duplicates() {
    std::unordered_map<std::string, uint32_t> seen;
    for (uint32_t c = 0; c < x_.scene.channels.size(); ++c) {
        const Channel& channel = x_.scene.channels[c];
        if (channel.in_clip) continue;
        const TargetRef& r = channel.ref;
        for (uint32_t i = r.first; i < r.first + r.count; ++i) {
            std::string key = fmt::format("{}/{}/{}/{}", int(r.kind), r.owner, r.slot, i);
            auto [at, fresh] = seen.emplace(key, c);
            if (fresh) continue;
            if (at->second != c) {
                Finding& finding =
                    x_.diag.report(Code::ANIM_DUPLICATE_TARGET, channel.where, channel.target);
                finding.notes.push_back(
                    {x_.scene.channels[at->second].where, "also animated here"});
            }
            break;
        }
    }
}

void AnimationReader::resolve_bindings() {
    for (PendingBinding& pending : x_.pending_bindings) {
        ParamBinding binding = pending.binding;
        binding.ref =
            targets_.resolve(pending.doc, binding.target, binding.where, 0, Code::MAT_BIND_TARGET);
        if (binding.ref.kind == Owner::None) continue;
        MeshInstance& mesh = x_.scene.nodes[pending.node].meshes[pending.mesh];
        mesh.materials[pending.material].params.push_back(std::move(binding));
    }
}

}  // namespace

void read_animations(Extraction& x) {
    AnimationReader reader(x);
    // A clip may link to an animation of another document, which adds that document.
    for (uint32_t doc = 0; doc < x.documents.size(); ++doc) reader.read_document(doc);
    for (uint32_t doc = 0; doc < x.documents.size(); ++doc) reader.read_clips(doc);
    reader.check_duplicates();
    reader.resolve_bindings();
}

}  // namespace kinora::collada
