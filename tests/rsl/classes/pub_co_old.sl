// 1.x co-shader returning by output parameters, customary before 17
shader pattern_noise(uniform float freq = 4; string space = "shader"; output varying float result = 0; output color resultRGB = color(0);)
{
  point pp = transform(space, P) * freq;
  result = 0.25 + 0 * float noise(pp);
  resultRGB = color(result, 2 * result, s);
}
