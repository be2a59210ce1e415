// collada/extract/extract_p.h: what the parts of extract() share. Each part reads one kind of
// element and fills its list of SceneData; `made` remembers which element became which entry.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "collada/document/findings.h"
#include "collada/extract/extract.h"
#include "collada/extract/linked_documents_p.h"
#include "collada/extract/memory_budget_p.h"
#include "collada/scene/scene.h"
#include "collada/schema/links.h"
#include "runtime/base/picture_search.h"

namespace kinora::collada {

// An element of one of the documents.
struct Link {
    uint32_t doc = kNone;
    const Element* element = nullptr;
    explicit operator bool() const { return element != nullptr; }
};

// Look-ups that many elements repeat, made once.
struct GeometrySymbols {
    std::vector<uint32_t> groups;                                // the first of each symbol
    std::unordered_map<std::string_view, uint32_t> first_group;  // by symbol
    std::map<std::pair<uint32_t, std::string>, std::vector<uint32_t>> sets;  // group, semantic
};
struct NameIndex {
    size_t known = 0;  // entries of the list that are in it
    std::unordered_map<std::string, uint32_t> at;
};

// The <newparam>s of elements, by sid.
class NewParams {
  public:
    // Seen from `from`: in the elements around it, inside out; or null.
    const Element* find(const Element& from, std::string_view sid);

  private:
    using Table = std::unordered_map<std::string_view, const Element*>;
    std::unordered_map<const Element*, Table> of_;      // by the element around them
    std::unordered_map<const Element*, Table> inside_;  // an effect's profiles
};

// The <image>s of documents, by the names that exporters use in place of their ids.
class ImageNames {
  public:
    explicit ImageNames(const LinkedDocuments& documents) : documents_(documents) {}
    const Element* find(uint32_t doc, const std::string& name);  // null: there is none

  private:
    using Table = std::unordered_map<std::string, const Element*>;
    const LinkedDocuments& documents_;
    std::unordered_map<uint32_t, Table> of_;  // by document
};

// Nodes whose index is given out and whose content is still to be read.
class NodeQueue {
  public:
    void add(uint32_t index, Link node) {
        filled_.push_back(false);
        waiting_.push_back({index, node});
    }
    void reverse() { std::reverse(waiting_.begin(), waiting_.end()); }
    bool empty() const { return waiting_.empty(); }
    std::pair<uint32_t, Link> take() {
        auto last = waiting_.back();
        waiting_.pop_back();
        return last;
    }
    bool is_filled(uint32_t index) const { return filled_[index]; }
    void set_filled(uint32_t index) { filled_[index] = true; }
    void add_filled() { filled_.push_back(true); }  // one that no element describes

  private:
    std::vector<std::pair<uint32_t, Link>> waiting_;
    std::vector<bool> filled_;
};

// Units and axes: a document's own, and those of elements with an <asset> of their own.
class AssetFrames {
  public:
    AssetFrames(const LinkedDocuments& documents, Diagnostics& diag, SceneData& scene)
        : documents_(documents), diag_(diag), scene_(scene) {}

    // A number for the unit and up axis that hold inside an element; equal ones are one.
    uint32_t of(Link element);
    uint32_t of_world();  // the root document's
    uint32_t of_earth();  // of a .kml's places: metres, z up
    // Index into SceneData::conversions for things of frame `to` used in `from`; kNone if the same.
    uint32_t conversion(uint32_t from, uint32_t to);

  private:
    struct Own {
        std::optional<double> meter;
        std::optional<UpAxis> up_axis;
    };
    using OwnFrames = std::unordered_map<const Element*, Own>;  // by the element around <asset>
    const OwnFrames& own_frames(uint32_t doc);
    uint32_t number(double meter, UpAxis up_axis);

    const LinkedDocuments& documents_;
    Diagnostics& diag_;
    SceneData& scene_;
    std::unordered_map<uint32_t, OwnFrames> own_;  // by document
    std::vector<std::pair<double, UpAxis>> frames_;
    std::map<std::pair<double, UpAxis>, uint32_t> number_of_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> conversion_of_;
};

// The parts of instances that can only be resolved when all nodes are known.
struct PendingBinding {
    uint32_t node, mesh, material;  // scene.nodes[node].meshes[mesh].materials[material]
    ParamBinding binding;
    uint32_t doc;
};
struct PendingSkin {
    uint32_t node, mesh;
    Link instance;
};

// One run of extract(): the scene that grows, and what is known of the documents behind it.
struct Extraction {
    Extraction(Diagnostics& diagnostics, const ExtractOptions& extract_options)
        : diag(diagnostics), options(extract_options) {}
    Extraction(const Extraction&) = delete;

    Diagnostics& diag;
    const ExtractOptions& options;
    SceneData scene;
    MemoryBudget budget{diag};
    LinkedDocuments documents{diag, options, budget, scene};
    PictureSearch pictures;
    ImageNames image_names{documents};
    std::unordered_map<std::string, uint32_t> file_images;  // by path: images without an <image>
    AssetFrames frames{documents, diag, scene};
    std::vector<uint32_t> geometry_frames, skin_frames;  // of SceneData's lists
    // Copies of targets of morphs, by geometry and frame.
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> converted_geometries;

    // Definitions by element; kNone: tried and not usable (reported).
    std::unordered_map<const Element*, uint32_t> made;
    // Elements (of a value, or around one) that a channel may name.
    std::unordered_map<const Element*, TargetRef> target_of;
    NewParams newparams;
    std::unordered_map<uint32_t, GeometrySymbols> symbols_of_geometry;
    std::unordered_map<uint64_t, NameIndex> params_of_effect;  // by the effect's position
    std::unordered_map<uint32_t, NameIndex> setparams_of_material;

    NodeQueue nodes;
    uint32_t reached_nodes = kNone;  // those behind are read by read_everything
    std::vector<PendingBinding> pending_bindings;
    std::vector<PendingSkin> pending_skins;
    std::vector<std::pair<uint32_t, Link>> hidden_nodes;   // and the <visibility> of each
    std::unordered_set<const Element*> moving_visibility;  // that channels name
    int controller_depth = 0;  // of <controller>s whose sources are being read
    // Where targets of a morph were left out: weight as written -> weight kept, or kNone.
    std::unordered_map<uint32_t, std::vector<uint32_t>> morph_remap;
    std::unordered_set<const Element*> read_arrays;  // whose numbers were parsed and checked
    std::unordered_set<uint32_t> disordered;         // documents whose NODE_ORDER was reported

    const Document& document(uint32_t doc) const { return documents[doc]; }
    Location where(Link link) const { return documents[link.doc].location(*link.element); }
    Location where(Link link, std::string_view attribute) const {
        return documents[link.doc].location(*link.element, attribute);
    }
    // For `used`, an element that `user` refers to: see AssetFrames.
    uint32_t conversion(Link user, Link used) {
        return frames.conversion(frames.of(user), frames.of(used));
    }
    Location text_where(Link link) const {
        return documents[link.doc].text_location(*link.element);
    }
};

// extract.cpp: fills x.scene; false when there is nothing to show.
bool extract_into(Extraction& x, const Document& document);

// everything.cpp: the library items of the root document that nothing reached.
void read_everything(Extraction& x);

// links.cpp -------------------------------------------------------------------------------

using Kinds = std::initializer_list<std::string_view>;

// The element that `url` of attribute `attribute` (or of the text, when that is "") names: "#id",
// "other.dae#id", or a bare id with a warning. Reported, and null, unless its name is in `kinds`.
Link resolve(Extraction& x, Link from, std::string_view attribute, Kinds kinds);
// LINK_AMBIGUOUS where `first`, which `id` led to, is not the only one of these kinds.
void report_ambiguous(Extraction& x, Link first, std::string_view id, Kinds kinds, Location where);
// Of elements that share an id, so many are looked at; else links and ids multiply.
inline constexpr size_t kMostSameId = 256;
// The element with this id in one document whose name is in `kinds`, or null; reports nothing.
const Element* find_kind(const Document& document, std::string_view id, Kinds kinds);
// asset.cpp
Asset read_asset(const Document& document, Diagnostics& diag);
// What wrote the document, as it says itself: "Blender 2.93.0 commit date:...".
std::string_view authoring_tool(const Document& document);
// The version of Blender that an authoring tool's name begins with, such as 279 for 2.79; nothing
// for other tools. Lights are in watts and emission is a color since kBlenderWatts.
inline constexpr int kBlenderWatts = 280;
std::optional<int> blender_version(std::string_view tool);
void read_time_range(Extraction& x, Link visual_scene);
// What lies around it.
void read_environment(Extraction& x, Link visual_scene);

// images.cpp -------------------------------------------------------------------------------

// Reports what is unportable about the spelling of a file's URI.
void check_file_uri(Extraction& x, std::string_view uri, Location where);

// black_effects.cpp: gives colors to effects that would be black where the file says otherwise;
// reports it.
void mend_black_effects(Extraction& x);

// transparency.cpp: marks materials that the formula makes invisible; reports them.
void check_transparency(Extraction& x);

// texcoords.cpp: how the texture coordinates that a material names are found on the mesh;
// says what was assumed. Adds bindings for names that no <bind_vertex_input> binds.
void bind_texcoords(Extraction& x, uint32_t geometry, MaterialBinding& binding);

// embedded_image.cpp: writes the bytes that `data` spells in hexadecimal into a file that lasts as
// long as scene.files; "" (reported) when they are no image.
std::string unpack_image(Extraction& x, Link data, std::string_view format, std::string_view id);

// images.cpp: index into scene.images, or kNone.
uint32_t image_index(Extraction& x, Link image);
// Of what exporters write in place of an image's id: "#id", its name, its file's name. kNone: there
// is no such image.
uint32_t image_called(Extraction& x, uint32_t doc, std::string_view name);
// Of the file itself, if there is one; no <image> has it.
uint32_t file_image(Extraction& x, Link user, std::string_view uri);

// nodes.cpp -------------------------------------------------------------------------------

uint32_t node_index(Extraction& x, Link node);  // may add to pending_nodes
void read_pending_nodes(Extraction& x);
// Hides nodes by the <visibility> of their extras that nothing moves, unless that hides every mesh.
void settle_visibility(Extraction& x);
// Removes node instances that close a cycle or pass the limit of unrolled nodes.
void check_node_graph(Extraction& x);

// The groups of a geometry by the symbols of their materials.
GeometrySymbols& symbols_of(Extraction& x, uint32_t geometry);

// transform.cpp
bool is_transform(std::string_view name);
Transform read_transform(Extraction& x, Link link);
// Exchanges the scale and the translation of a node that Blender wrote in the wrong order.
void mend_order(Extraction& x, Link node, std::vector<Transform>& transforms);

// instances.cpp: instances inside a node.
void read_mesh_instance(Extraction& x, Link link, Node& node, uint32_t node_number);
void read_light_instance(Extraction& x, Link link, Node& node);
void read_camera_instance(Extraction& x, Link link, Node& node);
void read_node_instance(Extraction& x, Link link, Node& node);

// lights.cpp: <shadows> of an RSL extra, "0" or "false" for none; nothing if silent.
std::optional<bool> read_shadows(const Element& owner);

// mesh.cpp and its like -------------------------------------------------------------------

uint32_t geometry_index(Extraction& x, Link geometry);

// The values an <input source> gives, through its accessor.
struct SourceView {
    Link source;
    uint32_t stride = 0;            // values per entry after unnamed params are left out
    size_t count = 0;               // entries
    std::vector<uint32_t> columns;  // where each of `stride` stands within array_stride
    size_t offset = 0, array_stride = 1;
    const Element* array = nullptr;
};
// Reads accessor and counts of a <source>; array->text is not parsed. False: reported, unusable.
// How many numbers of the array the <param>s of an accessor cover.
uint64_t accessor_width(const Element& accessor);
bool read_accessor(Extraction& x, Link source, size_t array_length, SourceView& view);
// All values of a numeric source as doubles, entry by entry. Empty when unusable.
struct DoubleSource {
    uint32_t stride = 0;
    size_t count = 0;
    std::vector<double> values;
};
DoubleSource read_double_source(Extraction& x, Link source);
// All words of a Name_array, IDREF_array or SIDREF_array source.
struct NameSource {
    JointNames kind = JointNames::Name;
    uint64_t written_count = 0;  // the array's count attribute, 0 if none
    std::vector<std::string_view> names;
    const Element* array = nullptr;
};
NameSource read_name_source(Extraction& x, Link source);
// The first child <input semantic="...">, or null.
const Element* find_input(const Element& parent, std::string_view semantic);

// Counts while one is read: controllers that change each other's results are read in each other.
class ControllerDepth {
  public:
    explicit ControllerDepth(Extraction& x) : x_(x) { ++x_.controller_depth; }
    ~ControllerDepth() { --x_.controller_depth; }
    ControllerDepth(const ControllerDepth&) = delete;
    bool fits(Link controller) const;  // reports it where there are too many

  private:
    Extraction& x_;
};

// skin.cpp, morph.cpp
uint32_t skin_index(Extraction& x, Link controller);   // of a <controller> with <skin>
uint32_t morph_index(Extraction& x, Link controller);  // of a <controller> with <morph>
dmat4 matrix_of_rows(const double* rows);

// joints.cpp
void resolve_joints(Extraction& x);

// cameras.cpp, lights.cpp
uint32_t camera_index(Extraction& x, Link camera);
uint32_t light_index(Extraction& x, Link light);
// A <float sid> like element with one number (or `count`) as a slot; registers it as a target.
Slot read_slot(Extraction& x, Link link, uint32_t count, TargetRef ref);

// materials.cpp, params.cpp, effects.cpp, common.cpp,
// samplers.cpp, rsl.cpp
uint32_t material_index(Extraction& x, Link material);
// A material made of an <instance_effect>.
uint32_t instance_effect_index(Extraction& x, Link instance);
// Materials of the <instance_effect>s in <extra><technique profile="RSL"> children of `owner`.
std::vector<uint32_t> rsl_extra_materials(Extraction& x, Link owner);
// The <technique profile=...> of the <extra> children, or null.
const Element* extra_technique(const Element& owner, std::string_view profile);
bool read_param_value(Extraction& x, Link value, ParamValue& out);
// The child that is a value (<float>, <color>, ...) or null.
const Element* value_child(const Element& owner);
uint32_t effect_index(Extraction& x, Link effect);
// The innermost parameter of that sid, or kNone.
uint32_t find_param(Extraction& x, const Effect& effect, std::string_view sid);
void read_common(Extraction& x, Link profile, uint32_t effect_number, Effect& effect);
void read_rsl(Extraction& x, Link profile, uint32_t effect_number, Effect& effect);
void read_params(Extraction& x, Link owner, ParamScope scope, uint32_t effect_number,
                 Effect& effect);
// Index into effect.samplers of the texture `name`, or kNone (reported).
uint32_t texture_sampler(Extraction& x, Link texture, Effect& effect);
// A <setparam> of a surface or sampler: the material's own image. False if it sets something else.
bool set_sampler(Extraction& x, Link setparam, const Effect& effect, Material& material);

// animation.cpp, sampler.cpp; targets_p.h resolves targets
// ---------------------------------

// Channels and clips of all documents; then the <bind target>s that instances left open.
void read_animations(Extraction& x);
// Fills `sampler`; false (reported) when it has no usable keys.
bool read_sampler(Extraction& x, Link link, Sampler& sampler);

template <class T>
uint32_t append(std::vector<T>& list, T item) {
    list.push_back(std::move(item));
    return uint32_t(list.size() - 1);
}

}  // namespace kinora::collada
