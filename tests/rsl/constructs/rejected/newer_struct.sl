// struct
struct Sample { color radiance; float weight; }
surface newer_struct() { Sample x; x->weight = 1; Ci = unknown; }
