// runtime/picture/explain/explain_p.h: the sections, a function each.
#pragma once

#include "runtime/picture/explain/explain.h"
#include "runtime/scene/scene.h"

namespace kinora {

// Adds rows of one section.
class ExplainedRows {
  public:
    explicit ExplainedRows(std::vector<Explained>& rows) : rows_(rows) {}
    void section(std::string_view name) { section_ = name; }
    void add(std::string subject, std::string what, std::string why) {
        rows_.push_back({section_, std::move(subject), true, std::move(what), std::move(why)});
    }
    void leave_out(std::string subject, std::string what, std::string why) {
        rows_.push_back({section_, std::move(subject), false, std::move(what), std::move(why)});
    }

  private:
    std::vector<Explained>& rows_;
    std::string_view section_;
};

std::string shown_node(const Scene& scene, uint32_t node);

void explain_meshes(const Scene& scene, const Pose& pose,
                    ExplainedRows& rows);  // explain_motion.cpp
void explain_animation(const Scene& scene, const Pose& pose, ExplainedRows& rows);
void explain_shaders(const Scene& scene, const Pose& pose,
                     ExplainedRows& rows);  // explain_shaders.cpp
void explain_lights(const Scene& scene, const Pose& pose,
                    ExplainedRows& rows);  // explain_lights.cpp
void explain_passes(const Scene& scene, const Pose& pose,
                    ExplainedRows& rows);  // explain_passes.cpp
void explain_textures(const Scene& scene, const Pose& pose, ExplainedRows& rows);

}  // namespace kinora
