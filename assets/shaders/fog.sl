/* fog.sl: what lies behind fades into a colour, half of it gone every 0.69 of `distance`.
   An atmosphere, or the interior of an object. */
volume fog(float distance = 1; color background = 0) {
    float fogged = 1 - exp(-length(I) / distance);
    Ci = mix(Ci, background, fogged);
    Oi = mix(Oi, color(1), fogged);
}
