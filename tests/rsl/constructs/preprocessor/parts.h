#ifndef PARTS_H
#define PARTS_H
// A header of preprocessor_include.sl, without a last newline.
float half(float x) {
    return x * 0.5;
}
#define PART_SCALE 0.75
#endif