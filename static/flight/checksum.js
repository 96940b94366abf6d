/**
 * A checksum of JSON values that does not depend on how numbers are written: heli2dof_core/flight/checksum.py makes the
 * same. CRC-32 of the values' bytes: any single bit that changes changes it. Pure.
 */

const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  let own = n;
  for (let bit = 0; bit < 8; bit++) own = own & 1 ? 0xedb88320 ^ (own >>> 1) : own >>> 1;
  return own;
});

/** @param {unknown} value  of what JSON can hold @returns {string} eight hexadecimal digits */
export function checksum(value) {
  const sum = new Sum();
  sum.add(value);
  return sum.digits;
}

class Sum {
  #state = 0xffffffff;
  #view = new DataView(new ArrayBuffer(8));

  get digits() {
    return ((this.#state ^ 0xffffffff) >>> 0).toString(16).padStart(8, '0');
  }

  /** @param {unknown} value */
  add(value) {
    if (value === null) this.#letter('z');
    else if (value === true || value === false) this.#letter(value ? 't' : 'f');
    else if (typeof value === 'number') this.#number(value);
    else if (typeof value === 'string') this.#text(value);
    else if (Array.isArray(value)) {
      this.#count('l', value.length);
      for (const own of value) this.add(own);
    } else this.#object(/** @type {Record<string, unknown>} */ (value));
  }

  /** @param {number} value */
  #number(value) {
    this.#letter('n');
    this.#view.setFloat64(0, value + 0, true); // JSON.stringify(-0) is 0
    for (let i = 0; i < 8; i++) this.#byte(this.#view.getUint8(i));
  }

  /** @param {string} text */
  #text(text) {
    this.#count('s', 2 * text.length);
    for (let i = 0; i < text.length; i++) {
      const unit = text.charCodeAt(i);
      this.#byte(unit & 255);
      this.#byte(unit >>> 8);
    }
  }

  /** Names in the order of their code units. @param {Record<string, unknown>} value */
  #object(value) {
    const names = Object.keys(value).sort();
    this.#count('o', names.length);
    for (const name of names) {
      this.add(name);
      this.add(value[name]);
    }
  }

  /** @param {string} letter @param {number} count */
  #count(letter, count) {
    this.#letter(letter);
    for (let shift = 0; shift < 32; shift += 8) this.#byte((count >>> shift) & 255);
  }

  /** @param {string} letter */
  #letter(letter) {
    this.#byte(letter.charCodeAt(0));
  }

  /** @param {number} byte */
  #byte(byte) {
    this.#state = TABLE[(this.#state ^ byte) & 255] ^ (this.#state >>> 8);
  }
}
