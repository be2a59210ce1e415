// tests/runtime/scene/ri/scene_text.h: a stream with most kinds of requests and arguments.
#pragma once

namespace kinora::ri {

inline constexpr const char* kSceneText = R"(
Declare "myarray" "uniform integer[3]" Declare "Cs" "uniform color" Declare "a b" "float"
Option "searchpath" "string shader" ["a:\\\\b&"] "myarray" [1 -2 300]
Format 640 480 -1 DepthOfField 2.8 .1 3 PixelFilter "mitchell" 4 4 Quantize "rgba" 255 0 255 .5
Projection "perspective" "fov" 33.3 ColorSamples [1 0 0 0 1 0] [1 0 0 0 1 0] Color [.1 .7]
ColorSamples [1 0 0 0 1 0 0 0 1] [1 0 0 0 1 0 0 0 1]
WorldBegin
  LightSource "spot" 5 "from" [1 2 3] "a b" 7 Illuminate 5 0
  Basis "b-spline" 1 [1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16.5] 2
  Transform [1 0 0 0 0 1 0 0 0 0 1 0 0.1 123456.789 -1e-30 1]
  AttributeBegin Surface "quote\"\\\n\001" "string s" "x" "point[2] p" [1 2 3 4 5 6]
    Sphere 1 -1 1 360 "Cs" [1 0 0]
    Polygon "P" [0 0 0 1 0 0 0 1 0] "varying color Os" [1 0 0 0 1 0 0 0 1]
    SubdivisionMesh "catmull-clark" [3] [0 1 2] ["crease" "hole"] [2 1 1 0] [0 1 0] [5] "P" [0 0 0 1 0 0 0 1 0]
    TrimCurve [1] [2] [0 0 1 1] [0] [1] [2] [0 1] [0 1] [1 1]
    NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 "Pw" [0 0 0 1 1 0 0 1 0 1 0 1 1 1 0 1]
    Blobby 1 [1001 0] [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] [""]
    Curves "cubic" [4 7] "nonperiodic" "P" [0 0 0 1 1 1 2 2 2 3 3 3 0 0 0 1 1 1 2 2 2 3 3 3 4 4 4 5 5 5 6 6 6] "constantwidth" [.1]
  AttributeEnd
  IfBegin "1" ElseIf "2" Else IfEnd
  ObjectBegin "a" Procedural "RunProgram" ["a b" "c"] [0 1 0 1 0 1] ObjectEnd ObjectInstance "a"
WorldEnd
)";

}  // namespace kinora::ri
