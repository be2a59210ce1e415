// output parameters as AOVs, varying and uniform
surface aov_outputs(output varying color diffusecolor = 0; output varying color specularcolor = 0;
                    output varying float depthz = 0; output varying normal nworld = 0;
                    output varying point where = 0; output varying vector toward = 0) {
    normal Nf = faceforward(normalize(N), I);
    diffusecolor = Cs * 0.5;
    specularcolor = pow(max(0, Nf.-normalize(I)), 8);
    depthz = zcomp(P);
    nworld = normalize(ntransform("world", N));
    where = P; toward = -I;
    Ci = diffusecolor + specularcolor;
}
