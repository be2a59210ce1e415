// runtime/scene/ri/state/shader_calls.h: shaders, lights and maps of the current attributes.
#pragma once

#include "runtime/scene/description/cube_name.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/ri/state/shader_linker.h"
#include "runtime/scene/ri/state/shader_search.h"
#include "runtime/scene/ri/state/state.h"

namespace kinora::ri {

class ShaderCalls {
  public:
    ShaderCalls(State& state, StateReport& report, Diagnostics& diagnostics);

    // False: the request is none of these.
    bool call(const Call& call);

    // The shader that the call names by its argument `name_at`. Null: the name is that of no
    // shader, or of one that does nothing.
    Binding bind(const Call& call, size_t name_at, std::string_view kind);
    std::shared_ptr<const rsl::Shader> find(std::string_view name);
    // A world begins, or ends: then `picture` gets the pictures of the maps that its shaders were
    // given, or of all that were made. Later maps may be made of its displays.
    void begin_world() { outside_ = used_; }
    void end_world(int world, bool all_maps, FilePicture& picture);
    // Where files of a kind are looked for ("shader", "texture", "archive"), "" or ending in '/'.
    std::vector<std::string> folders(std::string_view kind) const;

  private:
    void light_source(const Call& call);
    void illuminate(const Call& call);
    void surface(const Call& call);
    void shader_layer(const Call& call);
    void co_shader(const Call& call);
    void connect_layers(const Call& call);
    void make_map(const Call& call);
    void make_cube_map(const Call& call);
    void make_shadow(const Call& call);
    std::vector<Binding>* layers_of(std::string_view type);
    ShaderBinding binding_of(const Call& call, std::shared_ptr<const rsl::Shader> shader);
    Light light_of(const Call& call);
    void report_unusable(std::string_view kind, std::string_view name, const rsl::Shader* found,
                         std::string_view instead);
    std::string map_name(std::string_view parameter, const std::string& name,
                         const rsl::Shader& shader);
    std::string picture_file(const std::string& name, bool any_suffix) const;
    std::string made_picture(const std::string& picture);
    const MapPicture* use_picture(const std::string& picture);

    State& state_;
    StateReport& report_;
    ShaderSearch search_;
    ShaderLinker linker_;
    std::map<int, Light> lights_;
    // A map that the file makes: one picture and how it is looked up, or six.
    struct MadeMap {
        TextureName one;
        std::optional<CubeName> six;
    };
    std::map<std::string, MadeMap, std::less<>> maps_;
    std::set<std::string, std::less<>> shadows_;  // that it makes
    std::map<std::string, int> makers_;           // the last world that has a display of the name
    std::set<MapPicture> used_, outside_;         // of maps: in all, before the world
};

}  // namespace kinora::ri
