// extern of shader globals in functions of the file
color facing() {
    extern vector I;
    extern normal N;
    extern color Cs;
    varying float d = normalize(I) . normalize(N);
    return Cs * d * d;
}
surface function_extern_globals() { Ci = facing(); Oi = Os; }
