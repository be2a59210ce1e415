class strings(string root = "maps/", name = "wood"; string exts[2] = {"tex", "tif"}; uniform float frame = 12;) {
  uniform string m_file = ""; uniform string parts[];
  public void construct() {
    m_file = concat(root, name, ".", exts[0]);
    push(parts, m_file); push(parts, format("%s.%04d", name, frame)); push(parts, sprintf("%d", frame));
  }
  public void surface(output color Ci, Oi) {
    float a = m_file == "maps/wood.tex", b = match("wood", m_file), c = stof(parts[2]);
    Ci = color(a, b, c); Oi = color(strlen(m_file), arraylength(parts), parts[1] == "wood.0012");
  }
}
