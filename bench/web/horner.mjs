// What one writes by hand: coefficients of powers once, then Horner's rule over typed arrays.
const BERNSTEIN = [[1, 0, 0, 0], [-3, 3, 0, 0], [3, -6, 3, 0], [-1, 3, -3, 1]];

export class Horner {
  /** points: 48 values a patch, u fastest. */
  constructor(points) {
    this.count = points.length / 48;
    this.c = new Float64Array(points.length); // of each patch and component: row l of v, power k of u
    for (let p = 0; p < this.count; p++) {
      for (let d = 0; d < 3; d++) {
        for (let l = 0; l < 4; l++) {
          for (let k = 0; k < 4; k++) {
            let sum = 0;
            for (let j = 0; j < 4; j++) {
              for (let i = 0; i < 4; i++) sum += BERNSTEIN[l][j] * BERNSTEIN[k][i] * points[48 * p + 12 * j + 3 * i + d];
            }
            this.c[48 * p + 16 * d + 4 * l + k] = sum;
          }
        }
      }
    }
  }

  /** x y z of every sample into `out`; planes: all x, then all y, then all z. */
  positions(nu, nv, out, planes) {
    const { c, count } = this, samples = count * nu * nv, du = 1 / (nu - 1), dv = 1 / (nv - 1);
    const step = planes ? 1 : 3, y = planes ? samples : 1, z = 2 * y;
    for (let p = 0, at = 0; p < count; p++) {
      for (let iv = 0; iv < nv; iv++) {
        const v = iv * dv;
        const row = (o) => ((c[o + 12] * v + c[o + 8]) * v + c[o + 4]) * v + c[o];
        const o = 48 * p;
        const x0 = row(o), x1 = row(o + 1), x2 = row(o + 2), x3 = row(o + 3);
        const y0 = row(o + 16), y1 = row(o + 17), y2 = row(o + 18), y3 = row(o + 19);
        const z0 = row(o + 32), z1 = row(o + 33), z2 = row(o + 34), z3 = row(o + 35);
        for (let iu = 0; iu < nu; iu++, at += step) {
          const u = iu * du;
          out[at] = ((x3 * u + x2) * u + x1) * u + x0;
          out[at + y] = ((y3 * u + y2) * u + y1) * u + y0;
          out[at + z] = ((z3 * u + z2) * u + z1) * u + z0;
        }
      }
    }
  }
}
