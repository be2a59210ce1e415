surface x() {
    float i = 0;
    i++;
    float j = 7 % 2;
    Ci = i & j;
}
//! 3:6 warning RSL_INCREMENT '++' is not part of the shading language 3.2
//! 4:17 error RSL_NOT_RSL '%' is not part of the shading language 3.2
//! 5:12 error RSL_NOT_RSL '&' is not part of the shading language 3.2
