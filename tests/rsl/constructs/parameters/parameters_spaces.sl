// defaults in spaces: point "world", color "hsv", vector, matrix "shader" 1
surface parameters_spaces(point center = point "world"(0, 0, 0); color tint = color "hsv"(0.1, 0.5, 0.9);
                          vector up = vector "object"(0, 1, 0); normal flat = normal "camera"(0, 0, 1);
                          matrix frame = matrix "shader" 1; point plain = point "shader"(1, 0, 0)) {
    float d = distance(P, center) + length(plain);
    Ci = tint * d + color(up) * (normalize(flat) . normalize(N)) + comp(frame, 0, 0);
}
