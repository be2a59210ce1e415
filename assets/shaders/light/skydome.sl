/* skydome.sl: the whole sky as a lamp: blue above, pale at the horizon, the ground's light from
   below, and a glow around where the sun is. Without shadows: it comes from everywhere.
   Parameters: intensity, zenithcolor, horizoncolor, groundcolor, sunglow and its direction. */
light skydome(float intensity = 1.1; color zenithcolor = color(0.22, 0.42, 0.85);
              color horizoncolor = color(0.85, 0.80, 0.72);
              color groundcolor = color(0.20, 0.15, 0.10); float sunglow = 0.9;
              vector sun = vector "world" (-0.6, -0.5, 0.45);) {
    vector up = normalize(vtransform("world", vector Ns));
    float h = zcomp(up);
    color sky = mix(horizoncolor, zenithcolor, smoothstep(-0.2, 0.9, h));
    sky = mix(sky, groundcolor, 0.5 - 0.5 * clamp(h * 1.2, -1, 1));
    float toward = max(0, normalize(vector Ns) . normalize(sun));
    Cl = intensity * (sky + sunglow * toward * toward * color(1, 0.75, 0.45));
}
