class co_checks(float n = 2; string __category = "pattern,color") {
  public float evaluate(float u, v) { return mod(floor(u*n) + floor(v*n), 2); }
  public color evaluate(float u, v) { float f = evaluate(u, v); return mix(color 0.25, color 1, f); }
}
