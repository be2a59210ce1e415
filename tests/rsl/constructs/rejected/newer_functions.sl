// samples of another shader, of RSL 2.0
class newer_functions(shader m = null;) { public void lighting(output color Ci, Oi) { Ci = directlighting(m, getlights()); } }
