// class: directlighting() and indirectspecular() of another shader
class samples_of_another(shader m = null;) {
    public void lighting(output color Ci, Oi) {
        __radiancesample kept[];
        Ci = directlighting(m, getlights(), "materialsamples", kept) + indirectspecular(m);
    }
}
