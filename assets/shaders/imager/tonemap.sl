/* tonemap.sl: keeps the colours of highlights: a film's shoulder instead of a hard edge at 1.
   Parameters: exposure in stops, white (what becomes white), contrast of the toe. */
imager tonemap(float exposure = 0.6; float white = 4; float contrast = 1.12;) {
    float shoulder(float x) {
        /* Reinhard's curve with a white point. */
        return x * (1 + x / (white * white)) / (1 + x);
    }
    color c = max(Ci, color(0, 0, 0)) * pow(2, exposure);
    float lum = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    float mapped = shoulder(lum);
    color even = c * (mapped / max(lum, 0.00001));
    color each = color(shoulder(c[0]), shoulder(c[1]), shoulder(c[2]));
    /* Between keeping the hue and letting it bleach. */
    color both = mix(even, each, smoothstep(0.3, 1, mapped));
    Ci = color(pow(both[0], contrast), pow(both[1], contrast), pow(both[2], contrast));
}
