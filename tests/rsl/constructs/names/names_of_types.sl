// color, normal, point, output as names where no type can stand
surface names_of_types(float point = 2; color color = 0.5) {
    normal normal = normalize(N);
    float output = s;
    output *= 2;
    Ci = color * output * point;
    Ci += (normal . normal) * 0.1;
    color *= 2;
    Ci += color;
}
