class sharing(string children[] = {"c1", "c2", "c1"}; shader named = getshader("c1");) {
  shader m_kids[];
  constant float m_n = arraylength(children);
  public void construct() {
    uniform float i;
    for (i = 0; i < m_n; i += 1) {
      shader k = getshader(children[i]);
      if (k != null) push(m_kids, k);
    }
  }
  public void surface(output color Ci, Oi) {
    float total = 0; uniform float i;
    for (i = 0; i < arraylength(m_kids); i += 1) {
      total += m_kids[i]->value(i);
      if (m_kids[i] == named) total += 100;
    }
    Ci = color(total, arraylength(m_kids), named->gain);
    Oi = 1;
  }
}
