/* haze.sl: the air of a summer day: what is far turns blue first and pale later, each colour at its
   own rate; towards the light's side the air glows.
   Parameters: blueness and whiteness (per unit), skycolor, suncolor, sun's direction. */
volume haze(float blueness = 0.045; float whiteness = 0.02;
            color skycolor = color(0.42, 0.58, 0.85); color suncolor = color(1, 0.82, 0.58);
            vector sun = vector "world" (-0.7, 0.6, 0.3);) {
    float way = length(I);
    color extinction = blueness * color(0.25, 0.55, 1.25) + whiteness;
    color through = color(exp(-way * comp(extinction, 0)), exp(-way * comp(extinction, 1)),
                          exp(-way * comp(extinction, 2)));
    float cosine = normalize(I) . normalize(sun);
    /* Scattering forwards (Henyey and Greenstein, g = 0.6), scaled to 1 in the middle. */
    float phase = (1 - 0.36) / pow(1 + 0.36 - 1.2 * cosine, 1.5);
    color air = mix(skycolor, suncolor, clamp(0.25 * phase, 0, 1));
    Ci = Ci * through + Oi * air * (color(1, 1, 1) - through);
    /* The background is filled too, as far as the air reaches. */
    Oi = max(Oi, color(1, 1, 1) - through);
}
