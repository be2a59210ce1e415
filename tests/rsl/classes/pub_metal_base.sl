struct Material {
   color m_base;
   float gain;
   void init(color c; float g) { m_base = c; gain = g; }
   color albedo() { return m_base * gain; }
}
struct Metal : Material {
   float rough;
   void init(color c; float g; float r) { Material::init(c, g); rough = r; }
   color albedo() { return Material::albedo() * (1 - rough); }
}
class metal(color base = color(1, .8, .4); float rough = .25) {
   Metal m;
   uniform Material flat;
   public void begin() { m->init(base, 2, rough); flat->init(color .5, 1); }
   public void surface(output color Ci, Oi) { Ci = m->albedo() + flat->albedo(); Oi = 1; }
}
