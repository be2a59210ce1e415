// class: a volume
class class_volume(float density = 0.1; color fog = 0.5;) {
    public void volume(output color Ci, Oi) {
        float thick = 1 - exp(-length(I) * density);
        Ci = mix(Ci, fog, color thick);
        Oi = mix(Oi, color 1, thick);
    }
}
