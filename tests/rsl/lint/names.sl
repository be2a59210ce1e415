float unheard(float a) { return a; }
float scale(float a, spare) { return 2 * a; }
float twice(float a) {
    float s = a;
    return s + s;
}
surface x(float Ka = 1, Kd = 0.5; output varying float kept = 0; string __category = "key";) {
    float a = 1, b, c, d;
    float list[2];
    color Kd = 0;
    b = 2;
    b += 1;
    if (s > 0.5) c = 1;
    float seen = c + d;
    float kr, kt;
    fresnel(I, N, 1.5, kr, kt);
    float last;
    for (float i = 0; i < 3; i += 1) {
        if (i > 0) seen += last;
        last = i;
    }
    void keep() { extern float a; a = 3; }
    keep();
    list[0] = 1;
    Ci = Ka * seen * kr * Kd * scale(s, t) * twice(t) * list[1];
}
//! 1:7 warning RSL_UNUSED_FUNCTION 'unheard'
//! 2:22 warning RSL_UNUSED_PARAMETER 'spare'
//! 4:11 warning RSL_HIDES this 's' hides the shader global
//! 7:25 warning RSL_UNUSED_PARAMETER 'Kd'
//! 8:11 warning RSL_UNUSED_VARIABLE 'a'
//! 8:18 warning RSL_UNUSED_VARIABLE 'b'
//! 10:11 warning RSL_HIDES this 'Kd' hides a parameter
//! 14:22 warning RSL_UNSET 'd' is read before it is set
