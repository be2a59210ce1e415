struct Coord { varying point Q; varying float s, t; varying vector dQu, dQv; }
struct Tile { Coord c; float id[2]; string tag = "t"; color tints[] = {color 1, color 0.5}; void cell(point p) { c->Q = p; c->s = mod(p[0], 1); c->t = mod(p[1], 1); id[0] = floor(p[0]); id[1] = floor(p[1]); } }
class tiles(float scale = 2;) {
  Tile m_tile, m_other;
  Coord coords[2];
  public void begin() {
    m_tile->cell(P * scale);
    m_other = m_tile;
    coords[0] = m_tile->c;
    coords[1]->s = coords[0]->s * 2;
    coords[1]->Q = P;
  }
  float read(Tile q) { return q->c->s + 10 * q->id[0] + 100 * q->id[1]; }
  Coord give(uniform float k) { return coords[k]; }
  public void surface(output color Ci, Oi) {
    Coord got = give(1);
    Ci = color(read(m_other), got->s, coords[1]->Q[1]);
    Oi = m_tile->tints[1] * arraylength(m_tile->tints);
  }
}
