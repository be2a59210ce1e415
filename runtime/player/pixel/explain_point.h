// runtime/player/pixel/explain_point.h: a recorded point, run again by the reference evaluator.
#pragma once

#include "runtime/player/pixel/pixel_story.h"
#include "runtime/player/pixel/point_recorder.h"

namespace kinora {

PointStory explain_point(RecordedPoint& point, const SourceFiles& files);

}  // namespace kinora
