surface x() {
    color list[];
    float numbers[] = {1, 2};
    push(list, numbers);
    Ci = list[0];
}
//! 4:5 error RSL_NO_OVERLOAD no form of 'push' takes (color[], float[])
