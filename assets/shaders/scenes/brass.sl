/* brass.sl: stamped metal: its highlights have its own color, and it mirrors a room that is bright
   above and dark below. */
surface brass(float Ka = 1; float Kd = 0.25; float Ks = 1.1; float roughness = 0.13;
              color metal = color(0.78, 0.53, 0.22);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    vector R = reflect(-V, Nf);
    float up = zcomp(vtransform("world", normalize(R)));
    color room = mix(color(0.04, 0.03, 0.025), color(0.55, 0.52, 0.5), smoothstep(-0.25, 0.8, up));
    Oi = Os;
    Ci = Os * Cs * metal * (Ka * room + Kd * diffuse(Nf) + Ks * specular(Nf, V, 8 * roughness));
}
