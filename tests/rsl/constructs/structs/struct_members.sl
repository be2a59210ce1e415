// struct: members of every type, defaults, structs in structs, assignment, arrays of structs
struct Inner {
    float weight = 2;
    color tint = color(0.5, 0.25, 1);
    string label = "inner";
}
struct Sample {
    uniform float count = 3;
    varying point where = point(1, 2, 3);
    vector away;
    normal up = normal(0, 1, 0);
    matrix frame = 1;
    float list[3] = {1, 2, 3};
    Inner inner;
    Inner other;
};
surface struct_members(output varying color aov_tint = 0; output varying float aov_sum = 0;) {
    Sample a, b;
    a->away = N;
    a->inner->weight += s;
    a->list[1] = t * a->inner->weight;
    b = a;
    b->inner->tint *= 2;
    b->inner->tint[1] = s;
    Inner several[4];
    float k;
    for (k = 0; k < 4; k += 1) {
        several[k]->weight = k * s;
        several[k]->tint += color(k, s, t);
    }
    several[2] = a->inner;
    a->other = several[1];
    Inner grown[];
    push(grown, a->inner);
    push(grown, several[3]);
    resize(grown, 4);
    Inner last = grown[1];
    if (several[0]->label == "inner" && b->inner->label == "inner") aov_sum = 1;
    aov_tint = b->inner->tint + several[2]->tint * a->other->tint + last->tint;
    aov_sum += b->away . a->up + b->list[1] + several[3]->weight + b->count + xcomp(b->where) +
               arraylength(grown) + comp(b->frame, 1, 1) + grown[3]->weight;
    Ci = aov_tint * aov_sum;
    Oi = 1;
}
