// class: diffuse and specular light apart, with the irradiance; no parameters
class class_two_passes {
    color kept = 0;
    public void diffuselighting(output color Ci, Oi, Ii) {
        Ii = diffuse(normalize(N));
        Ci = Ii * Cs;
        kept = Ii;
    }
    public void specularlighting(output color Ci, Oi) {
        Ci += kept * specular(normalize(N), normalize(-I), 0.2);
        Ci *= Oi;
    }
}
