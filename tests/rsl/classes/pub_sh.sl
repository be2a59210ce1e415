#include <stdrsl/SphericalHarmonics.h>
class shlight(string shfile = ""; float gain = 1;) {
  stdrsl_SphericalHarmonic m_sh, m_cos;
  uniform color m_coeffs[9];
  public void construct() {
    uniform float i; for (i = 0; i < 9; i += 1) m_coeffs[i] = i == 0 ? color(2) : color(0);
    if (shfile != "") textureinfo(shfile, "shcoeffs", m_coeffs);
    m_sh->createFromArray(m_coeffs);
    float zh[9] = {3.141593, 0, 2.094395, 0, 0, 0, 0.785398, 0, 0};
    m_cos->createFromArray(zh);
  }
  public void surface(output color Ci, Oi) { m_sh->rotate("world"); Ci = gain * m_sh->convolve(m_cos, 0); Oi = 1; }
}
