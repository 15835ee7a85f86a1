/* bendlab viewer, sources 3079d07c00611381a2e4db32206c6519fd5f142597e9c2747e4f6fef1fda628e; licences in LICENSES.txt */
(()=>{var rr=null;function Xt(){if(!rr){let n=document.getElementById("bendlab-data");rr=n?JSON.parse(n.textContent):{runs:[],charts:[]},rr.byId=new Map((rr.runs??[]).map(t=>[t.id,t]))}return rr}function Ui(n,t=document.activeElement){document.dispatchEvent(new CustomEvent("bendlab:open",{detail:{ids:n,from:t}}))}var Zg="http://www.w3.org/2000/svg";function C(n,t={},...e){return Ou(document.createElement(n),t,e)}function Tt(n,t={},...e){return Ou(document.createElementNS(Zg,n),t,e)}function Ou(n,t,e){for(let[i,s]of Object.entries(t)){let r=i.startsWith("aria-");s==null||s===!1&&!r||(i.startsWith("on")?n.addEventListener(i.slice(2),s):n.setAttribute(i,s===!0&&!r?"":String(s)))}return n.append(...e.filter(i=>i!=null&&i!==!1)),n}function Ge(n,t,e={}){return C("button",{type:"button",class:"button",onclick:t,...e},n)}async function Fi(n,t){let e=await Jg(n)?"Copied":"Press Ctrl-C";if(!t)return;let i=t.dataset.text??=t.textContent;t.textContent=e,setTimeout(()=>{t.textContent=i},1400)}async function Jg(n){try{return await navigator.clipboard.writeText(n),!0}catch{let t=C("textarea",{class:"off-screen",readonly:!0});t.value=n,(document.querySelector("dialog[open]")??document.body).append(t),t.select();let e=document.execCommand("copy");return t.remove(),e}}function ar(n,t){let e=URL.createObjectURL(t),i=C("a",{href:e,download:n});document.body.append(i),i.click(),i.remove(),setTimeout(()=>URL.revokeObjectURL(e),1e4)}function Ke(n){return n==="\u221E"?1/0:n==="-\u221E"?-1/0:typeof n=="number"?n:NaN}function Vt(n,t=3){if(Number.isNaN(n))return"\u2013";if(!Number.isFinite(n))return n>0?"\u221E":"\u2212\u221E";if(n===0)return"0";let e=Math.abs(n);if(e>=1e5||e<.001){let[s,r]=n.toExponential(t-1).split("e");return`${Ln(s)}\xB710${oa(Number(r))}`}let i=Math.max(t-1-Math.floor(Math.log10(e)),0);return Ln(n.toFixed(i))}function pn(n,t,e){return t&&t!=="1"?`${Vt(n,e)}\u202F${t}`:Vt(n,e)}function ci(n,t){return t&&t!=="1"?`${n} (${t})`:n}var Ln=n=>n.replace("-","\u2212");function oa(n){return String(n).replace(/[-\d]/g,t=>t==="-"?"\u207B":"\u2070\xB9\xB2\xB3\u2074\u2075\u2076\u2077\u2078\u2079"[Number(t)])}var dc=7,Nn=14;function or(n,t){let e=[""];for(let i of n.split(" "))e.at(-1)&&e.at(-1).length+i.length>=t?e.push(i):e[e.length-1]+=(e.at(-1)?" ":"")+i;return e}function rs(n,{y:t,...e}){return n.map((i,s)=>Tt("text",{...e,y:t+Nn*(s+1-n.length)},i))}function la({scale:n,ticks:t,text:e},i,s,r){let a=Tt("g",{class:"axis","aria-hidden":"true"});for(let o of t){let l=n(o);r?a.append(Tt("path",{class:"grid",d:`M${l} ${i.top}V${i.bottom}`})):a.append(Tt("path",{class:"tick",d:`M${l} ${i.bottom}v5`})),a.append(Tt("text",{x:l,y:i.bottom+19,"text-anchor":"middle"},e(o)))}return a.append(Tt("path",{class:"base",d:`M${i.left} ${i.bottom}H${i.right}`})),a.append(...ku(s,i,i.bottom+39+Nn*(s.length-1))),a}function Bu({scale:n,ticks:t,text:e},i,s,r){let a=Tt("g",{class:"axis","aria-hidden":"true"});for(let o of t)a.append(Tt("text",{x:n(o),y:r,"text-anchor":"middle"},e(o)));return a.append(...ku(s,i,r-20)),a}var ku=(n,t,e)=>rs(n,{class:"title",x:(t.left+t.right)/2,y:e,"text-anchor":"middle"});function zu({kind:n,scale:t,ticks:e,text:i},s,r,a){let o=Tt("g",{class:"axis","aria-hidden":"true"});for(let l of e){let c=t(l),h=a?{x:s.left,y:c+11-t.step()/2}:{x:s.left-8,y:c+4,"text-anchor":"end"};o.append(Tt("path",{class:"grid",d:`M${s.left} ${c}H${s.right}`})),o.append(Tt("text",{...h,class:n==="band"?"category":null},i(l)))}return o.append(...rs(r,{class:"title",x:0,y:12+Nn*(r.length-1)})),o}function Vu(n){return n.kind==="bars"?jg(n):Kg(n)}function Kg(n){let t=n.held??[],e=n.series.some(r=>r.low),i=n.ys.flatMap(r=>e?[r.name,`${r.name}_low`,`${r.name}_high`]:[r.name]),s=[["series",...t.map(r=>r.name),n.x.name,...i,"runs"]];for(let r of n.series){let a=t.map((o,l)=>o.values[r.held[l]]);r.x.forEach((o,l)=>{let c=n.ys.flatMap(({name:f})=>{let u=[r.y[f]?.[l]];return e&&u.push(r.low?.[f]?.[l]??u[0],r.high?.[f]?.[l]??u[0]),u.map(Ke).map(Gu)}),h=Array.isArray(r.runs?.[l])?r.runs[l].join(" "):r.run??"";s.push([r.label,...a,n.x.categories?.[o]??o,...c,h])})}return Hu(s)}function jg(n){let t=[["row",...n.parts.map(e=>`${e.label} (${n.x.unit})`),"runs"]];for(let e of n.rows)t.push([e.label,...e.values.map(Gu),(e.runs??[]).join(" ")]);return Hu(t)}function Gu(n){return Number.isNaN(n)?"":Number.isFinite(n)?String(n):n>0?"inf":"-inf"}function Qg(n){let t=String(n??"");return/^[=+@\t\r]|^-[^\d.]/.test(t)&&(t=`'${t}`),/[",\n\r]/.test(t)?`"${t.replaceAll('"','""')}"`:t}var Hu=n=>n.map(t=>t.map(Qg).join(",")).join(`
`)+`
`;function Dn(n,t,e,i){let s=C("select",{onchange:()=>i(s.selectedIndex)},...t.map((r,a)=>C("option",{selected:a===e},r)));return C("label",{class:"choice"},C("span",{},n),s)}function ca(n,t,e,i){let s=Ge(n,()=>{let r=s.getAttribute("aria-pressed")!=="true";s.setAttribute("aria-pressed",r),e(r)},{"aria-pressed":t,title:i});return s}function ha(n){let e=[Ge("CSV",()=>ar(`${n.id}.csv`,new Blob([Vu(n)],{type:"text/csv;charset=utf-8"})),{title:"Save the data of this chart"})];if(n.command){let i=s=>Fi(n.command,s.currentTarget);e.push(Ge("Copy command",i,{title:n.command}))}return C("span",{class:"take-away"},...e)}function Wu(n,t,e,i){let s=n.map((c,h)=>h).sort((c,h)=>n[c]-n[h]),r=[];s.forEach((c,h)=>{let f=n[c]-h*t,u=1;for(;r.length&&r.at(-1).mean>f;){let d=r.pop();f=(f*u+d.mean*d.count)/(u+d.count),u+=d.count}r.push({mean:f,count:u})});let a=r.flatMap(({mean:c,count:h})=>Array(h).fill(c)),o=i-(s.length-1)*t,l=Array(n.length);return s.forEach((c,h)=>{l[c]=Math.min(Math.max(a[h],e),Math.max(e,o))+h*t}),l}var lr=Math.PI,pc=2*lr,Oi=1e-6,t0=pc-Oi;function Xu(n){this._+=n[0];for(let t=1,e=n.length;t<e;++t)this._+=arguments[t]+n[t]}function e0(n){let t=Math.floor(n);if(!(t>=0))throw new Error(`invalid digits: ${n}`);if(t>15)return Xu;let e=10**t;return function(i){this._+=i[0];for(let s=1,r=i.length;s<r;++s)this._+=Math.round(arguments[s]*e)/e+i[s]}}function qu(n,t,e,i){return n===e&&t===i}function n0(n){let t=Math.floor(n);if(!(t<=15))return qu;let e=10**t,i=function(s){return Math.round(s*e)};return function(s,r,a,o){return i(s)===i(a)&&i(r)===i(o)}}var as=class{constructor(t){this._x0=this._y0=this._x1=this._y1=null,this._="",this._append=t==null?Xu:e0(t),this._equal=t==null?qu:n0(t)}moveTo(t,e){this._append`M${this._x0=this._x1=+t},${this._y0=this._y1=+e}`}closePath(){this._x1!==null&&(this._x1=this._x0,this._y1=this._y0,this._append`Z`)}lineTo(t,e){this._append`L${this._x1=+t},${this._y1=+e}`}quadraticCurveTo(t,e,i,s){this._append`Q${+t},${+e},${this._x1=+i},${this._y1=+s}`}bezierCurveTo(t,e,i,s,r,a){this._append`C${+t},${+e},${+i},${+s},${this._x1=+r},${this._y1=+a}`}arcTo(t,e,i,s,r){if(t=+t,e=+e,i=+i,s=+s,r=+r,r<0)throw new Error(`negative radius: ${r}`);let a=this._x1,o=this._y1,l=i-t,c=s-e,h=a-t,f=o-e,u=h*h+f*f;if(this._x1===null)this._append`M${this._x1=t},${this._y1=e}`;else if(u>Oi)if(!(Math.abs(f*l-c*h)>Oi)||!r)this._append`L${this._x1=t},${this._y1=e}`;else{let d=i-a,m=s-o,_=l*l+c*c,p=d*d+m*m,g=Math.sqrt(_),M=Math.sqrt(u),A=r*Math.tan((lr-Math.acos((_+u-p)/(2*g*M)))/2),b=A/M,E=A/g;Math.abs(b-1)>Oi&&this._append`L${t+b*h},${e+b*f}`,this._append`A${r},${r},0,0,${+(f*d>h*m)},${this._x1=t+E*l},${this._y1=e+E*c}`}}arc(t,e,i,s,r,a){if(t=+t,e=+e,i=+i,a=!!a,i<0)throw new Error(`negative radius: ${i}`);let o=i*Math.cos(s),l=i*Math.sin(s),c=t+o,h=e+l,f=1^a,u=a?s-r:r-s;if(this._x1===null?this._append`M${c},${h}`:(Math.abs(this._x1-c)>Oi||Math.abs(this._y1-h)>Oi)&&this._append`L${c},${h}`,!!i){if(u<0&&(u=u%pc+pc),u>t0)this._append`A${i},${i},0,1,${f},${t-o},${e-l}A${i},${i},0,1,${f},${this._x1=c},${this._y1=h}`;else if(u>Oi){let d=t+i*Math.cos(r),m=e+i*Math.sin(r);if(u>=lr&&this._equal(c,h,d,m)){u/=2;let _=s+u;this._append`A${i},${i},0,${+(u>=lr)},${f},${t+i*Math.cos(_)},${e+i*Math.sin(_)}`}this._append`A${i},${i},0,${+(u>=lr)},${f},${this._x1=d},${this._y1=m}`}}}rect(t,e,i,s){this._append`M${this._x0=this._x1=+t},${this._y0=this._y1=+e}h${i=+i}v${+s}h${-i}Z`}toString(){return this._}};function i0(){return new as}i0.prototype=as.prototype;function Un(n){return function(){return n}}var s0=Math.cos;var r0=Math.min,xc=Math.sin,mn=Math.sqrt,$u=1e-12,cr=Math.PI,ww=cr/2,yc=2*cr;function ju(n){let t=3;return n.digits=function(e){if(!arguments.length)return t;if(e==null)t=null;else{let i=Math.floor(e);if(!(i>=0))throw new RangeError(`invalid digits: ${e}`);t=i}return n},()=>new as(t)}var Aw=Array.prototype.slice;function a0(n){return typeof n=="object"&&"length"in n?n:Array.from(n)}function Qu(n){this._context=n}Qu.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(n,t):this._context.moveTo(n,t);break;case 1:this._point=2;default:this._context.lineTo(n,t);break}}};function tf(n){return new Qu(n)}function o0(n){return n[0]}function l0(n){return n[1]}function da(n,t){var e=Un(!0),i=null,s=tf,r=null,a=ju(o);n=typeof n=="function"?n:n===void 0?o0:Un(n),t=typeof t=="function"?t:t===void 0?l0:Un(t);function o(l){var c,h=(l=a0(l)).length,f,u=!1,d;for(i==null&&(r=s(d=a())),c=0;c<=h;++c)!(c<h&&e(f=l[c],c,l))===u&&((u=!u)?r.lineStart():r.lineEnd()),u&&r.point(+n(f,c,l),+t(f,c,l));if(d)return r=null,d+""||null}return o.x=function(l){return arguments.length?(n=typeof l=="function"?l:Un(+l),o):n},o.y=function(l){return arguments.length?(t=typeof l=="function"?l:Un(+l),o):t},o.defined=function(l){return arguments.length?(e=typeof l=="function"?l:Un(!!l),o):e},o.curve=function(l){return arguments.length?(s=l,i!=null&&(r=s(i)),o):s},o.context=function(l){return arguments.length?(l==null?i=r=null:r=s(i=l),o):i},o}var Tw=c0(tf);function ef(n){this._curve=n}ef.prototype={areaStart:function(){this._curve.areaStart()},areaEnd:function(){this._curve.areaEnd()},lineStart:function(){this._curve.lineStart()},lineEnd:function(){this._curve.lineEnd()},point:function(n,t){this._curve.point(t*Math.sin(n),t*-Math.cos(n))}};function c0(n){function t(e){return new ef(n(e))}return t._curve=n,t}var Ew=mn(3);var pa={draw(n,t){let e=mn(t/cr);n.moveTo(e,0),n.arc(0,0,e,0,yc)}},nf={draw(n,t){let e=mn(t/5)/2;n.moveTo(-3*e,-e),n.lineTo(-e,-e),n.lineTo(-e,-3*e),n.lineTo(e,-3*e),n.lineTo(e,-e),n.lineTo(3*e,-e),n.lineTo(3*e,e),n.lineTo(e,e),n.lineTo(e,3*e),n.lineTo(-e,3*e),n.lineTo(-e,e),n.lineTo(-3*e,e),n.closePath()}},sf=mn(1/3),h0=sf*2,rf={draw(n,t){let e=mn(t/h0),i=e*sf;n.moveTo(0,-e),n.lineTo(i,0),n.lineTo(0,e),n.lineTo(-i,0),n.closePath()}};var af={draw(n,t){let e=mn(t),i=-e/2;n.rect(i,i,e,e)}};var of=xc(cr/10)/xc(7*cr/10),Cw=xc(yc/10)*of,Rw=-s0(yc/10)*of;var mc=mn(3),vc={draw(n,t){let e=-mn(t/(mc*3));n.moveTo(0,e*2),n.lineTo(-mc*e,-e),n.lineTo(mc*e,-e),n.closePath()}},Iw=mn(3);var Pw=mn(3)/2,u0=1/mn(12),Lw=(u0/2+1)*3;var bc={draw(n,t){let e=mn(t-r0(t/6,1.7))*.6189;n.moveTo(-e,-e),n.lineTo(e,e),n.moveTo(-e,e),n.lineTo(e,-e)}};function lf(n,t){let e=null,i=ju(s);n=typeof n=="function"?n:Un(n||pa),t=typeof t=="function"?t:Un(t===void 0?64:+t);function s(){let r;if(e||(e=r=i()),n.apply(this,arguments).draw(e,+t.apply(this,arguments)),r)return e=null,r+""||null}return s.type=function(r){return arguments.length?(n=typeof r=="function"?r:Un(r),s):n},s.size=function(r){return arguments.length?(t=typeof r=="function"?r:Un(+r),s):t},s.context=function(r){return arguments.length?(e=r??null,s):e},s}function hi(){}function ua(n,t,e){n._context.bezierCurveTo((2*n._x0+n._x1)/3,(2*n._y0+n._y1)/3,(n._x0+2*n._x1)/3,(n._y0+2*n._y1)/3,(n._x0+4*n._x1+t)/6,(n._y0+4*n._y1+e)/6)}function Mc(n){this._context=n}Mc.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._y0=this._y1=NaN,this._point=0},lineEnd:function(){switch(this._point){case 3:ua(this,this._x1,this._y1);case 2:this._context.lineTo(this._x1,this._y1);break}(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(n,t):this._context.moveTo(n,t);break;case 1:this._point=2;break;case 2:this._point=3,this._context.lineTo((5*this._x0+this._x1)/6,(5*this._y0+this._y1)/6);default:ua(this,n,t);break}this._x0=this._x1,this._x1=n,this._y0=this._y1,this._y1=t}};function f0(n){this._context=n}f0.prototype={areaStart:hi,areaEnd:hi,lineStart:function(){this._x0=this._x1=this._x2=this._x3=this._x4=this._y0=this._y1=this._y2=this._y3=this._y4=NaN,this._point=0},lineEnd:function(){switch(this._point){case 1:{this._context.moveTo(this._x2,this._y2),this._context.closePath();break}case 2:{this._context.moveTo((this._x2+2*this._x3)/3,(this._y2+2*this._y3)/3),this._context.lineTo((this._x3+2*this._x2)/3,(this._y3+2*this._y2)/3),this._context.closePath();break}case 3:{this.point(this._x2,this._y2),this.point(this._x3,this._y3),this.point(this._x4,this._y4);break}}},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1,this._x2=n,this._y2=t;break;case 1:this._point=2,this._x3=n,this._y3=t;break;case 2:this._point=3,this._x4=n,this._y4=t,this._context.moveTo((this._x0+4*this._x1+n)/6,(this._y0+4*this._y1+t)/6);break;default:ua(this,n,t);break}this._x0=this._x1,this._x1=n,this._y0=this._y1,this._y1=t}};function d0(n){this._context=n}d0.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._y0=this._y1=NaN,this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===3)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1;break;case 1:this._point=2;break;case 2:this._point=3;var e=(this._x0+4*this._x1+n)/6,i=(this._y0+4*this._y1+t)/6;this._line?this._context.lineTo(e,i):this._context.moveTo(e,i);break;case 3:this._point=4;default:ua(this,n,t);break}this._x0=this._x1,this._x1=n,this._y0=this._y1,this._y1=t}};function cf(n,t){this._basis=new Mc(n),this._beta=t}cf.prototype={lineStart:function(){this._x=[],this._y=[],this._basis.lineStart()},lineEnd:function(){var n=this._x,t=this._y,e=n.length-1;if(e>0)for(var i=n[0],s=t[0],r=n[e]-i,a=t[e]-s,o=-1,l;++o<=e;)l=o/e,this._basis.point(this._beta*n[o]+(1-this._beta)*(i+l*r),this._beta*t[o]+(1-this._beta)*(s+l*a));this._x=this._y=null,this._basis.lineEnd()},point:function(n,t){this._x.push(+n),this._y.push(+t)}};var Nw=(function n(t){function e(i){return t===1?new Mc(i):new cf(i,t)}return e.beta=function(i){return n(+i)},e})(.85);function fa(n,t,e){n._context.bezierCurveTo(n._x1+n._k*(n._x2-n._x0),n._y1+n._k*(n._y2-n._y0),n._x2+n._k*(n._x1-t),n._y2+n._k*(n._y1-e),n._x2,n._y2)}function Sc(n,t){this._context=n,this._k=(1-t)/6}Sc.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._x2=this._y0=this._y1=this._y2=NaN,this._point=0},lineEnd:function(){switch(this._point){case 2:this._context.lineTo(this._x2,this._y2);break;case 3:fa(this,this._x1,this._y1);break}(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(n,t):this._context.moveTo(n,t);break;case 1:this._point=2,this._x1=n,this._y1=t;break;case 2:this._point=3;default:fa(this,n,t);break}this._x0=this._x1,this._x1=this._x2,this._x2=n,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var Dw=(function n(t){function e(i){return new Sc(i,t)}return e.tension=function(i){return n(+i)},e})(0);function wc(n,t){this._context=n,this._k=(1-t)/6}wc.prototype={areaStart:hi,areaEnd:hi,lineStart:function(){this._x0=this._x1=this._x2=this._x3=this._x4=this._x5=this._y0=this._y1=this._y2=this._y3=this._y4=this._y5=NaN,this._point=0},lineEnd:function(){switch(this._point){case 1:{this._context.moveTo(this._x3,this._y3),this._context.closePath();break}case 2:{this._context.lineTo(this._x3,this._y3),this._context.closePath();break}case 3:{this.point(this._x3,this._y3),this.point(this._x4,this._y4),this.point(this._x5,this._y5);break}}},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1,this._x3=n,this._y3=t;break;case 1:this._point=2,this._context.moveTo(this._x4=n,this._y4=t);break;case 2:this._point=3,this._x5=n,this._y5=t;break;default:fa(this,n,t);break}this._x0=this._x1,this._x1=this._x2,this._x2=n,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var Uw=(function n(t){function e(i){return new wc(i,t)}return e.tension=function(i){return n(+i)},e})(0);function Ac(n,t){this._context=n,this._k=(1-t)/6}Ac.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._x2=this._y0=this._y1=this._y2=NaN,this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===3)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1;break;case 1:this._point=2;break;case 2:this._point=3,this._line?this._context.lineTo(this._x2,this._y2):this._context.moveTo(this._x2,this._y2);break;case 3:this._point=4;default:fa(this,n,t);break}this._x0=this._x1,this._x1=this._x2,this._x2=n,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var Fw=(function n(t){function e(i){return new Ac(i,t)}return e.tension=function(i){return n(+i)},e})(0);function Tc(n,t,e){var i=n._x1,s=n._y1,r=n._x2,a=n._y2;if(n._l01_a>$u){var o=2*n._l01_2a+3*n._l01_a*n._l12_a+n._l12_2a,l=3*n._l01_a*(n._l01_a+n._l12_a);i=(i*o-n._x0*n._l12_2a+n._x2*n._l01_2a)/l,s=(s*o-n._y0*n._l12_2a+n._y2*n._l01_2a)/l}if(n._l23_a>$u){var c=2*n._l23_2a+3*n._l23_a*n._l12_a+n._l12_2a,h=3*n._l23_a*(n._l23_a+n._l12_a);r=(r*c+n._x1*n._l23_2a-t*n._l12_2a)/h,a=(a*c+n._y1*n._l23_2a-e*n._l12_2a)/h}n._context.bezierCurveTo(i,s,r,a,n._x2,n._y2)}function hf(n,t){this._context=n,this._alpha=t}hf.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._x2=this._y0=this._y1=this._y2=NaN,this._l01_a=this._l12_a=this._l23_a=this._l01_2a=this._l12_2a=this._l23_2a=this._point=0},lineEnd:function(){switch(this._point){case 2:this._context.lineTo(this._x2,this._y2);break;case 3:this.point(this._x2,this._y2);break}(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){if(n=+n,t=+t,this._point){var e=this._x2-n,i=this._y2-t;this._l23_a=Math.sqrt(this._l23_2a=Math.pow(e*e+i*i,this._alpha))}switch(this._point){case 0:this._point=1,this._line?this._context.lineTo(n,t):this._context.moveTo(n,t);break;case 1:this._point=2;break;case 2:this._point=3;default:Tc(this,n,t);break}this._l01_a=this._l12_a,this._l12_a=this._l23_a,this._l01_2a=this._l12_2a,this._l12_2a=this._l23_2a,this._x0=this._x1,this._x1=this._x2,this._x2=n,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var Ow=(function n(t){function e(i){return t?new hf(i,t):new Sc(i,0)}return e.alpha=function(i){return n(+i)},e})(.5);function uf(n,t){this._context=n,this._alpha=t}uf.prototype={areaStart:hi,areaEnd:hi,lineStart:function(){this._x0=this._x1=this._x2=this._x3=this._x4=this._x5=this._y0=this._y1=this._y2=this._y3=this._y4=this._y5=NaN,this._l01_a=this._l12_a=this._l23_a=this._l01_2a=this._l12_2a=this._l23_2a=this._point=0},lineEnd:function(){switch(this._point){case 1:{this._context.moveTo(this._x3,this._y3),this._context.closePath();break}case 2:{this._context.lineTo(this._x3,this._y3),this._context.closePath();break}case 3:{this.point(this._x3,this._y3),this.point(this._x4,this._y4),this.point(this._x5,this._y5);break}}},point:function(n,t){if(n=+n,t=+t,this._point){var e=this._x2-n,i=this._y2-t;this._l23_a=Math.sqrt(this._l23_2a=Math.pow(e*e+i*i,this._alpha))}switch(this._point){case 0:this._point=1,this._x3=n,this._y3=t;break;case 1:this._point=2,this._context.moveTo(this._x4=n,this._y4=t);break;case 2:this._point=3,this._x5=n,this._y5=t;break;default:Tc(this,n,t);break}this._l01_a=this._l12_a,this._l12_a=this._l23_a,this._l01_2a=this._l12_2a,this._l12_2a=this._l23_2a,this._x0=this._x1,this._x1=this._x2,this._x2=n,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var Bw=(function n(t){function e(i){return t?new uf(i,t):new wc(i,0)}return e.alpha=function(i){return n(+i)},e})(.5);function ff(n,t){this._context=n,this._alpha=t}ff.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._x2=this._y0=this._y1=this._y2=NaN,this._l01_a=this._l12_a=this._l23_a=this._l01_2a=this._l12_2a=this._l23_2a=this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===3)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){if(n=+n,t=+t,this._point){var e=this._x2-n,i=this._y2-t;this._l23_a=Math.sqrt(this._l23_2a=Math.pow(e*e+i*i,this._alpha))}switch(this._point){case 0:this._point=1;break;case 1:this._point=2;break;case 2:this._point=3,this._line?this._context.lineTo(this._x2,this._y2):this._context.moveTo(this._x2,this._y2);break;case 3:this._point=4;default:Tc(this,n,t);break}this._l01_a=this._l12_a,this._l12_a=this._l23_a,this._l01_2a=this._l12_2a,this._l12_2a=this._l23_2a,this._x0=this._x1,this._x1=this._x2,this._x2=n,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var kw=(function n(t){function e(i){return t?new ff(i,t):new Ac(i,0)}return e.alpha=function(i){return n(+i)},e})(.5);function p0(n){this._context=n}p0.prototype={areaStart:hi,areaEnd:hi,lineStart:function(){this._point=0},lineEnd:function(){this._point&&this._context.closePath()},point:function(n,t){n=+n,t=+t,this._point?this._context.lineTo(n,t):(this._point=1,this._context.moveTo(n,t))}};function Yu(n){return n<0?-1:1}function Zu(n,t,e){var i=n._x1-n._x0,s=t-n._x1,r=(n._y1-n._y0)/(i||s<0&&-0),a=(e-n._y1)/(s||i<0&&-0),o=(r*s+a*i)/(i+s);return(Yu(r)+Yu(a))*Math.min(Math.abs(r),Math.abs(a),.5*Math.abs(o))||0}function Ju(n,t){var e=n._x1-n._x0;return e?(3*(n._y1-n._y0)/e-t)/2:t}function gc(n,t,e){var i=n._x0,s=n._y0,r=n._x1,a=n._y1,o=(r-i)/3;n._context.bezierCurveTo(i+o,s+o*t,r-o,a-o*e,r,a)}function _c(n){this._context=n}_c.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._y0=this._y1=this._t0=NaN,this._point=0},lineEnd:function(){switch(this._point){case 2:this._context.lineTo(this._x1,this._y1);break;case 3:gc(this,this._t0,Ju(this,this._t0));break}(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){var e=NaN;if(n=+n,t=+t,!(n===this._x1&&t===this._y1)){switch(this._point){case 0:this._point=1,this._line?this._context.lineTo(n,t):this._context.moveTo(n,t);break;case 1:this._point=2;break;case 2:this._point=3,gc(this,Ju(this,e=Zu(this,n,t)),e);break;default:gc(this,this._t0,e=Zu(this,n,t));break}this._x0=this._x1,this._x1=n,this._y0=this._y1,this._y1=t,this._t0=e}}};function m0(n){this._context=new df(n)}(m0.prototype=Object.create(_c.prototype)).point=function(n,t){_c.prototype.point.call(this,t,n)};function df(n){this._context=n}df.prototype={moveTo:function(n,t){this._context.moveTo(t,n)},closePath:function(){this._context.closePath()},lineTo:function(n,t){this._context.lineTo(t,n)},bezierCurveTo:function(n,t,e,i,s,r){this._context.bezierCurveTo(t,n,i,e,r,s)}};function g0(n){this._context=n}g0.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x=[],this._y=[]},lineEnd:function(){var n=this._x,t=this._y,e=n.length;if(e)if(this._line?this._context.lineTo(n[0],t[0]):this._context.moveTo(n[0],t[0]),e===2)this._context.lineTo(n[1],t[1]);else for(var i=Ku(n),s=Ku(t),r=0,a=1;a<e;++r,++a)this._context.bezierCurveTo(i[0][r],s[0][r],i[1][r],s[1][r],n[a],t[a]);(this._line||this._line!==0&&e===1)&&this._context.closePath(),this._line=1-this._line,this._x=this._y=null},point:function(n,t){this._x.push(+n),this._y.push(+t)}};function Ku(n){var t,e=n.length-1,i,s=new Array(e),r=new Array(e),a=new Array(e);for(s[0]=0,r[0]=2,a[0]=n[0]+2*n[1],t=1;t<e-1;++t)s[t]=1,r[t]=4,a[t]=4*n[t]+2*n[t+1];for(s[e-1]=2,r[e-1]=7,a[e-1]=8*n[e-1]+n[e],t=1;t<e;++t)i=s[t]/r[t-1],r[t]-=i,a[t]-=i*a[t-1];for(s[e-1]=a[e-1]/r[e-1],t=e-2;t>=0;--t)s[t]=(a[t]-s[t+1])/r[t];for(r[e-1]=(n[e]+s[e-1])/2,t=0;t<e-1;++t)r[t]=2*n[t+1]-s[t+1];return[s,r]}function x0(n,t){this._context=n,this._t=t}x0.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x=this._y=NaN,this._point=0},lineEnd:function(){0<this._t&&this._t<1&&this._point===2&&this._context.lineTo(this._x,this._y),(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line>=0&&(this._t=1-this._t,this._line=1-this._line)},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(n,t):this._context.moveTo(n,t);break;case 1:this._point=2;default:{if(this._t<=0)this._context.lineTo(this._x,t),this._context.lineTo(n,t);else{var e=this._x*(1-this._t)+n*this._t;this._context.lineTo(e,this._y),this._context.lineTo(e,t)}break}}this._x=n,this._y=t}};var _0={o:pa,s:af,D:rf,"^":vc,v:vc,P:nf,X:bc,x:bc};function bn(n,t){return n.style.setProperty("--light",t.light),n.style.setProperty("--dark",t.dark),n.classList.add("painted"),n}var y0=52,v0=["X","x"];function Ec(n,t,e){let i=n.mark==="v"?" rotate(180)":"";return Tt("path",{class:v0.includes(n.mark)?"mark crossed":n.hollow?"mark hollow":"mark",d:lf(_0[n.mark]??pa,y0)(),transform:`translate(${t.toFixed(1)} ${e.toFixed(1)})${i}`})}function os(n,t="line"){let e=t==="line"?26:14,i=Tt("svg",{class:"sample",width:e,height:14,viewBox:`0 0 ${e} 14`,"aria-hidden":"true"});return t==="bar"?(i.append(Tt("rect",{class:"swatch",x:1,y:1,width:12,height:12,rx:2})),bn(i,n)):(t==="line"&&i.append(Tt("path",{class:"line",d:"M1 7H25","stroke-dasharray":n.dash})),i.append(Ec(n,e/2,7)),bn(i,n))}var ls=21,cs=class{constructor(t,e,i,s){this.hidden=new Set(t.filter(r=>r.hidden).map(({label:r})=>r)),this.buttons=new Map(t.map(({label:r,look:a})=>[r,this.#t(r,a,e)])),this.element=C("div",{class:"legend",role:"group","aria-label":"Series"},...this.buttons.values()),this.changed=i,this.pointed=s}#t(t,e,i){let s=r=>{r.shiftKey?this.#e(t):this.#n(t),this.#i()};return C("button",{type:"button",class:"series-name","aria-pressed":!this.hidden.has(t),onclick:s,title:"Show or hide this series; with Shift: show only this series",onpointerenter:()=>this.pointed(t),onpointerleave:()=>this.pointed(null),onfocus:()=>this.pointed(t),onblur:()=>this.pointed(null)},os(e,i),C("span",{},t))}#n(t){this.hidden.delete(t)||this.hidden.add(t)}#e(t){let e=this.hidden.size===this.buttons.size-1&&!this.hidden.has(t);this.hidden=new Set(e?[]:[...this.buttons.keys()].filter(i=>i!==t))}#i(){for(let[t,e]of this.buttons)e.setAttribute("aria-pressed",!this.hidden.has(t));this.changed()}fits(t){return this.buttons.size*ls<=t}flow(){this.element.classList.remove("beside");for(let t of this.buttons.values())t.style.removeProperty("top")}beside(t,e,i,s){this.element.classList.add("beside"),this.element.style.setProperty("left",`${e}px`);let r=[...this.buttons.keys()].filter(c=>!t.has(c)),a=Wu([...t.values()],ls,i,s-r.length*ls),o=new Map([...t.keys()].map((c,h)=>[c,a[h]])),l=Math.max(s-(r.length-1)*ls,Math.max(-1/0,...a)+ls);for(let c of r)this.buttons.get(c).style.setProperty("top",`${l}px`),l+=ls;for(let[c,h]of o)this.buttons.get(c).style.setProperty("top",`${h}px`);return o}get width(){return Math.max(...[...this.buttons.values()].map(t=>t.scrollWidth))}};function hr(n,t){return n==null||t==null?NaN:n<t?-1:n>t?1:n>=t?0:NaN}function b0(n,t){return n==null||t==null?NaN:t<n?-1:t>n?1:t>=n?0:NaN}function mf(n){let t,e,i;n.length!==2?(t=hr,e=(o,l)=>hr(n(o),l),i=(o,l)=>n(o)-l):(t=n===hr||n===b0?n:M0,e=n,i=n);function s(o,l,c=0,h=o.length){if(c<h){if(t(l,l)!==0)return h;do{let f=c+h>>>1;e(o[f],l)<0?c=f+1:h=f}while(c<h)}return c}function r(o,l,c=0,h=o.length){if(c<h){if(t(l,l)!==0)return h;do{let f=c+h>>>1;e(o[f],l)<=0?c=f+1:h=f}while(c<h)}return c}function a(o,l,c=0,h=o.length){let f=s(o,l,c,h-1);return f>c&&i(o[f-1],l)>-i(o[f],l)?f-1:f}return{left:s,center:a,right:r}}function M0(){return 0}function S0(n){return n===null?NaN:+n}var gf=mf(hr),xf=gf.right,Yw=gf.left,Zw=mf(S0).center;var Jw=_f(yf),Kw=_f(w0);function _f(n){return function(t,e,i=e){if(!((e=+e)>=0))throw new RangeError("invalid rx");if(!((i=+i)>=0))throw new RangeError("invalid ry");let{data:s,width:r,height:a}=t;if(!((r=Math.floor(r))>=0))throw new RangeError("invalid width");if(!((a=Math.floor(a!==void 0?a:s.length/r))>=0))throw new RangeError("invalid height");if(!r||!a||!e&&!i)return t;let o=e&&n(e),l=i&&n(i),c=s.slice();return o&&l?(hs(o,c,s,r,a),hs(o,s,c,r,a),hs(o,c,s,r,a),us(l,s,c,r,a),us(l,c,s,r,a),us(l,s,c,r,a)):o?(hs(o,s,c,r,a),hs(o,c,s,r,a),hs(o,s,c,r,a)):l&&(us(l,s,c,r,a),us(l,c,s,r,a),us(l,s,c,r,a)),t}}function hs(n,t,e,i,s){for(let r=0,a=i*s;r<a;)n(t,e,r,r+=i,1)}function us(n,t,e,i,s){for(let r=0,a=i*s;r<i;++r)n(t,e,r,r+a,i)}function w0(n){let t=yf(n);return(e,i,s,r,a)=>{s<<=2,r<<=2,a<<=2,t(e,i,s+0,r+0,a),t(e,i,s+1,r+1,a),t(e,i,s+2,r+2,a),t(e,i,s+3,r+3,a)}}function yf(n){let t=Math.floor(n);if(t===n)return A0(n);let e=n-t,i=2*n+1;return(s,r,a,o,l)=>{if(!((o-=l)>=a))return;let c=t*r[a],h=l*t,f=h+l;for(let u=a,d=a+h;u<d;u+=l)c+=r[Math.min(o,u)];for(let u=a,d=o;u<=d;u+=l)c+=r[Math.min(o,u+h)],s[u]=(c+e*(r[Math.max(a,u-f)]+r[Math.min(o,u+f)]))/i,c-=r[Math.max(a,u-h)]}}function A0(n){let t=2*n+1;return(e,i,s,r,a)=>{if(!((r-=a)>=s))return;let o=n*i[s],l=a*n;for(let c=s,h=s+l;c<h;c+=a)o+=i[Math.min(r,c)];for(let c=s,h=r;c<=h;c+=a)o+=i[Math.min(r,c+l)],e[c]=o/t,o-=i[Math.max(s,c-l)]}}var ur=class extends Map{constructor(t,e=C0){if(super(),Object.defineProperties(this,{_intern:{value:new Map},_key:{value:e}}),t!=null)for(let[i,s]of t)this.set(i,s)}get(t){return super.get(pf(this,t))}has(t){return super.has(pf(this,t))}set(t,e){return super.set(T0(this,t),e)}delete(t){return super.delete(E0(this,t))}};function pf({_intern:n,_key:t},e){let i=t(e);return n.has(i)?n.get(i):e}function T0({_intern:n,_key:t},e){let i=t(e);return n.has(i)?n.get(i):(n.set(i,e),e)}function E0({_intern:n,_key:t},e){let i=t(e);return n.has(i)&&(e=n.get(i),n.delete(i)),e}function C0(n){return n!==null&&typeof n=="object"?n.valueOf():n}var R0=Array.prototype,jw=R0.slice;var I0=Math.sqrt(50),P0=Math.sqrt(10),L0=Math.sqrt(2);function ma(n,t,e){let i=(t-n)/Math.max(0,e),s=Math.floor(Math.log10(i)),r=i/Math.pow(10,s),a=r>=I0?10:r>=P0?5:r>=L0?2:1,o,l,c;return s<0?(c=Math.pow(10,-s)/a,o=Math.round(n*c),l=Math.round(t*c),o/c<n&&++o,l/c>t&&--l,c=-c):(c=Math.pow(10,s)*a,o=Math.round(n/c),l=Math.round(t/c),o*c<n&&++o,l*c>t&&--l),l<o&&.5<=e&&e<2?ma(n,t,e*2):[o,l,c]}function xa(n,t,e){if(t=+t,n=+n,e=+e,!(e>0))return[];if(n===t)return[n];let i=t<n,[s,r,a]=i?ma(t,n,e):ma(n,t,e);if(!(r>=s))return[];let o=r-s+1,l=new Array(o);if(i)if(a<0)for(let c=0;c<o;++c)l[c]=(r-c)/-a;else for(let c=0;c<o;++c)l[c]=(r-c)*a;else if(a<0)for(let c=0;c<o;++c)l[c]=(s+c)/-a;else for(let c=0;c<o;++c)l[c]=(s+c)*a;return l}function ga(n,t,e){return t=+t,n=+n,e=+e,ma(n,t,e)[2]}function vf(n,t,e){t=+t,n=+n,e=+e;let i=t<n,s=i?ga(t,n,e):ga(n,t,e);return(i?-1:1)*(s<0?1/-s:s)}function bf(n,t,e){n=+n,t=+t,e=(s=arguments.length)<2?(t=n,n=0,1):s<3?1:+e;for(var i=-1,s=Math.max(0,Math.ceil((t-n)/e))|0,r=new Array(s);++i<s;)r[i]=n+i*e;return r}var Qw=N0(Math.random);function N0(n){return function(e,i=0,s=e.length){let r=s-(i=+i);for(;r;){let a=n()*r--|0,o=e[r+i];e[r+i]=e[a+i],e[a+i]=o}return e}}function ms(n,t,e){n.prototype=t.prototype=e,e.constructor=n}function pr(n,t){var e=Object.create(n.prototype);for(var i in t)e[i]=t[i];return e}function ui(){}var Vi=.7,ps=1/Vi,fs="\\s*([+-]?\\d+)\\s*",fr="\\s*([+-]?(?:\\d*\\.)?\\d+(?:[eE][+-]?\\d+)?)\\s*",Fn="\\s*([+-]?(?:\\d*\\.)?\\d+(?:[eE][+-]?\\d+)?)%\\s*",D0=/^#([0-9a-f]{3,8})$/,U0=new RegExp(`^rgb\\(${fs},${fs},${fs}\\)$`),F0=new RegExp(`^rgb\\(${Fn},${Fn},${Fn}\\)$`),O0=new RegExp(`^rgba\\(${fs},${fs},${fs},${fr}\\)$`),B0=new RegExp(`^rgba\\(${Fn},${Fn},${Fn},${fr}\\)$`),k0=new RegExp(`^hsl\\(${fr},${Fn},${Fn}\\)$`),z0=new RegExp(`^hsla\\(${fr},${Fn},${Fn},${fr}\\)$`),Mf={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074};ms(ui,gs,{copy(n){return Object.assign(new this.constructor,this,n)},displayable(){return this.rgb().displayable()},hex:Sf,formatHex:Sf,formatHex8:V0,formatHsl:G0,formatRgb:wf,toString:wf});function Sf(){return this.rgb().formatHex()}function V0(){return this.rgb().formatHex8()}function G0(){return Nf(this).formatHsl()}function wf(){return this.rgb().formatRgb()}function gs(n){var t,e;return n=(n+"").trim().toLowerCase(),(t=D0.exec(n))?(e=t[1].length,t=parseInt(t[1],16),e===6?Af(t):e===3?new Te(t>>8&15|t>>4&240,t>>4&15|t&240,(t&15)<<4|t&15,1):e===8?_a(t>>24&255,t>>16&255,t>>8&255,(t&255)/255):e===4?_a(t>>12&15|t>>8&240,t>>8&15|t>>4&240,t>>4&15|t&240,((t&15)<<4|t&15)/255):null):(t=U0.exec(n))?new Te(t[1],t[2],t[3],1):(t=F0.exec(n))?new Te(t[1]*255/100,t[2]*255/100,t[3]*255/100,1):(t=O0.exec(n))?_a(t[1],t[2],t[3],t[4]):(t=B0.exec(n))?_a(t[1]*255/100,t[2]*255/100,t[3]*255/100,t[4]):(t=k0.exec(n))?Cf(t[1],t[2]/100,t[3]/100,1):(t=z0.exec(n))?Cf(t[1],t[2]/100,t[3]/100,t[4]):Mf.hasOwnProperty(n)?Af(Mf[n]):n==="transparent"?new Te(NaN,NaN,NaN,0):null}function Af(n){return new Te(n>>16&255,n>>8&255,n&255,1)}function _a(n,t,e,i){return i<=0&&(n=t=e=NaN),new Te(n,t,e,i)}function Nc(n){return n instanceof ui||(n=gs(n)),n?(n=n.rgb(),new Te(n.r,n.g,n.b,n.opacity)):new Te}function mr(n,t,e,i){return arguments.length===1?Nc(n):new Te(n,t,e,i??1)}function Te(n,t,e,i){this.r=+n,this.g=+t,this.b=+e,this.opacity=+i}ms(Te,mr,pr(ui,{brighter(n){return n=n==null?ps:Math.pow(ps,n),new Te(this.r*n,this.g*n,this.b*n,this.opacity)},darker(n){return n=n==null?Vi:Math.pow(Vi,n),new Te(this.r*n,this.g*n,this.b*n,this.opacity)},rgb(){return this},clamp(){return new Te(ki(this.r),ki(this.g),ki(this.b),va(this.opacity))},displayable(){return-.5<=this.r&&this.r<255.5&&-.5<=this.g&&this.g<255.5&&-.5<=this.b&&this.b<255.5&&0<=this.opacity&&this.opacity<=1},hex:Tf,formatHex:Tf,formatHex8:H0,formatRgb:Ef,toString:Ef}));function Tf(){return`#${Bi(this.r)}${Bi(this.g)}${Bi(this.b)}`}function H0(){return`#${Bi(this.r)}${Bi(this.g)}${Bi(this.b)}${Bi((isNaN(this.opacity)?1:this.opacity)*255)}`}function Ef(){let n=va(this.opacity);return`${n===1?"rgb(":"rgba("}${ki(this.r)}, ${ki(this.g)}, ${ki(this.b)}${n===1?")":`, ${n})`}`}function va(n){return isNaN(n)?1:Math.max(0,Math.min(1,n))}function ki(n){return Math.max(0,Math.min(255,Math.round(n)||0))}function Bi(n){return n=ki(n),(n<16?"0":"")+n.toString(16)}function Cf(n,t,e,i){return i<=0?n=t=e=NaN:e<=0||e>=1?n=t=NaN:t<=0&&(n=NaN),new Mn(n,t,e,i)}function Nf(n){if(n instanceof Mn)return new Mn(n.h,n.s,n.l,n.opacity);if(n instanceof ui||(n=gs(n)),!n)return new Mn;if(n instanceof Mn)return n;n=n.rgb();var t=n.r/255,e=n.g/255,i=n.b/255,s=Math.min(t,e,i),r=Math.max(t,e,i),a=NaN,o=r-s,l=(r+s)/2;return o?(t===r?a=(e-i)/o+(e<i)*6:e===r?a=(i-t)/o+2:a=(t-e)/o+4,o/=l<.5?r+s:2-r-s,a*=60):o=l>0&&l<1?0:a,new Mn(a,o,l,n.opacity)}function Ma(n,t,e,i){return arguments.length===1?Nf(n):new Mn(n,t,e,i??1)}function Mn(n,t,e,i){this.h=+n,this.s=+t,this.l=+e,this.opacity=+i}ms(Mn,Ma,pr(ui,{brighter(n){return n=n==null?ps:Math.pow(ps,n),new Mn(this.h,this.s,this.l*n,this.opacity)},darker(n){return n=n==null?Vi:Math.pow(Vi,n),new Mn(this.h,this.s,this.l*n,this.opacity)},rgb(){var n=this.h%360+(this.h<0)*360,t=isNaN(n)||isNaN(this.s)?0:this.s,e=this.l,i=e+(e<.5?e:1-e)*t,s=2*e-i;return new Te(Cc(n>=240?n-240:n+120,s,i),Cc(n,s,i),Cc(n<120?n+240:n-120,s,i),this.opacity)},clamp(){return new Mn(Rf(this.h),ya(this.s),ya(this.l),va(this.opacity))},displayable(){return(0<=this.s&&this.s<=1||isNaN(this.s))&&0<=this.l&&this.l<=1&&0<=this.opacity&&this.opacity<=1},formatHsl(){let n=va(this.opacity);return`${n===1?"hsl(":"hsla("}${Rf(this.h)}, ${ya(this.s)*100}%, ${ya(this.l)*100}%${n===1?")":`, ${n})`}`}}));function Rf(n){return n=(n||0)%360,n<0?n+360:n}function ya(n){return Math.max(0,Math.min(1,n||0))}function Cc(n,t,e){return(n<60?t+(e-t)*n/60:n<180?e:n<240?t+(e-t)*(240-n)/60:t)*255}var Df=Math.PI/180,Uf=180/Math.PI,ba=18,Ff=.96422,Of=1,Bf=.82521,kf=4/29,ds=6/29,zf=3*ds*ds,W0=ds*ds*ds;function Vf(n){if(n instanceof On)return new On(n.l,n.a,n.b,n.opacity);if(n instanceof Zn)return Hf(n);n instanceof Te||(n=Nc(n));var t=Lc(n.r),e=Lc(n.g),i=Lc(n.b),s=Rc((.2225045*t+.7168786*e+.0606169*i)/Of),r,a;return t===e&&e===i?r=a=s:(r=Rc((.4360747*t+.3850649*e+.1430804*i)/Ff),a=Rc((.0139322*t+.0971045*e+.7141733*i)/Bf)),new On(116*s-16,500*(r-s),200*(s-a),n.opacity)}function Gf(n,t,e,i){return arguments.length===1?Vf(n):new On(n,t,e,i??1)}function On(n,t,e,i){this.l=+n,this.a=+t,this.b=+e,this.opacity=+i}ms(On,Gf,pr(ui,{brighter(n){return new On(this.l+ba*(n??1),this.a,this.b,this.opacity)},darker(n){return new On(this.l-ba*(n??1),this.a,this.b,this.opacity)},rgb(){var n=(this.l+16)/116,t=isNaN(this.a)?n:n+this.a/500,e=isNaN(this.b)?n:n-this.b/200;return t=Ff*Ic(t),n=Of*Ic(n),e=Bf*Ic(e),new Te(Pc(3.1338561*t-1.6168667*n-.4906146*e),Pc(-.9787684*t+1.9161415*n+.033454*e),Pc(.0719453*t-.2289914*n+1.4052427*e),this.opacity)}}));function Rc(n){return n>W0?Math.pow(n,1/3):n/zf+kf}function Ic(n){return n>ds?n*n*n:zf*(n-kf)}function Pc(n){return 255*(n<=.0031308?12.92*n:1.055*Math.pow(n,1/2.4)-.055)}function Lc(n){return(n/=255)<=.04045?n/12.92:Math.pow((n+.055)/1.055,2.4)}function X0(n){if(n instanceof Zn)return new Zn(n.h,n.c,n.l,n.opacity);if(n instanceof On||(n=Vf(n)),n.a===0&&n.b===0)return new Zn(NaN,0<n.l&&n.l<100?0:NaN,n.l,n.opacity);var t=Math.atan2(n.b,n.a)*Uf;return new Zn(t<0?t+360:t,Math.sqrt(n.a*n.a+n.b*n.b),n.l,n.opacity)}function Sa(n,t,e,i){return arguments.length===1?X0(n):new Zn(n,t,e,i??1)}function Zn(n,t,e,i){this.h=+n,this.c=+t,this.l=+e,this.opacity=+i}function Hf(n){if(isNaN(n.h))return new On(n.l,0,0,n.opacity);var t=n.h*Df;return new On(n.l,Math.cos(t)*n.c,Math.sin(t)*n.c,n.opacity)}ms(Zn,Sa,pr(ui,{brighter(n){return new Zn(this.h,this.c,this.l+ba*(n??1),this.opacity)},darker(n){return new Zn(this.h,this.c,this.l-ba*(n??1),this.opacity)},rgb(){return Hf(this).rgb()}}));var Wf=-.14861,Dc=1.78277,Uc=-.29227,wa=-.90649,dr=1.97294,If=dr*wa,Pf=dr*Dc,Lf=Dc*Uc-wa*Wf;function q0(n){if(n instanceof zi)return new zi(n.h,n.s,n.l,n.opacity);n instanceof Te||(n=Nc(n));var t=n.r/255,e=n.g/255,i=n.b/255,s=(Lf*i+If*t-Pf*e)/(Lf+If-Pf),r=i-s,a=(dr*(e-s)-Uc*r)/wa,o=Math.sqrt(a*a+r*r)/(dr*s*(1-s)),l=o?Math.atan2(a,r)*Uf-120:NaN;return new zi(l<0?l+360:l,o,s,n.opacity)}function Aa(n,t,e,i){return arguments.length===1?q0(n):new zi(n,t,e,i??1)}function zi(n,t,e,i){this.h=+n,this.s=+t,this.l=+e,this.opacity=+i}ms(zi,Aa,pr(ui,{brighter(n){return n=n==null?ps:Math.pow(ps,n),new zi(this.h,this.s,this.l*n,this.opacity)},darker(n){return n=n==null?Vi:Math.pow(Vi,n),new zi(this.h,this.s,this.l*n,this.opacity)},rgb(){var n=isNaN(this.h)?0:(this.h+120)*Df,t=+this.l,e=isNaN(this.s)?0:this.s*t*(1-t),i=Math.cos(n),s=Math.sin(n);return new Te(255*(t+e*(Wf*i+Dc*s)),255*(t+e*(Uc*i+wa*s)),255*(t+e*(dr*i)),this.opacity)}}));function Yf(n,t,e,i,s){var r=n*n,a=r*n;return((1-3*n+3*r-a)*t+(4-6*r+3*a)*e+(1+3*n+3*r-3*a)*i+a*s)/6}function $0(n){var t=n.length-1;return function(e){var i=e<=0?e=0:e>=1?(e=1,t-1):Math.floor(e*t),s=n[i],r=n[i+1],a=i>0?n[i-1]:2*s-r,o=i<t-1?n[i+2]:2*r-s;return Yf((e-i/t)*t,a,s,r,o)}}function Y0(n){var t=n.length;return function(e){var i=Math.floor(((e%=1)<0?++e:e)*t),s=n[(i+t-1)%t],r=n[i%t],a=n[(i+1)%t],o=n[(i+2)%t];return Yf((e-i/t)*t,s,r,a,o)}}var Ea=n=>()=>n;function Zf(n,t){return function(e){return n+e*t}}function Z0(n,t,e){return n=Math.pow(n,e),t=Math.pow(t,e)-n,e=1/e,function(i){return Math.pow(n+i*t,e)}}function kc(n,t){var e=t-n;return e?Zf(n,e>180||e<-180?e-360*Math.round(e/360):e):Ea(isNaN(n)?t:n)}function J0(n){return(n=+n)==1?je:function(t,e){return e-t?Z0(t,e,n):Ea(isNaN(t)?e:t)}}function je(n,t){var e=t-n;return e?Zf(n,e):Ea(isNaN(n)?t:n)}var Xf=(function n(t){var e=J0(t);function i(s,r){var a=e((s=mr(s)).r,(r=mr(r)).r),o=e(s.g,r.g),l=e(s.b,r.b),c=je(s.opacity,r.opacity);return function(h){return s.r=a(h),s.g=o(h),s.b=l(h),s.opacity=c(h),s+""}}return i.gamma=n,i})(1);function Jf(n){return function(t){var e=t.length,i=new Array(e),s=new Array(e),r=new Array(e),a,o;for(a=0;a<e;++a)o=mr(t[a]),i[a]=o.r||0,s[a]=o.g||0,r[a]=o.b||0;return i=n(i),s=n(s),r=n(r),o.opacity=1,function(l){return o.r=i(l),o.g=s(l),o.b=r(l),o+""}}}var iA=Jf($0),sA=Jf(Y0);function K0(n,t){t||(t=[]);var e=n?Math.min(t.length,n.length):0,i=t.slice(),s;return function(r){for(s=0;s<e;++s)i[s]=n[s]*(1-r)+t[s]*r;return i}}function j0(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function Q0(n,t){var e=t?t.length:0,i=n?Math.min(e,n.length):0,s=new Array(i),r=new Array(e),a;for(a=0;a<i;++a)s[a]=Ca(n[a],t[a]);for(;a<e;++a)r[a]=t[a];return function(o){for(a=0;a<i;++a)r[a]=s[a](o);return r}}function tx(n,t){var e=new Date;return n=+n,t=+t,function(i){return e.setTime(n*(1-i)+t*i),e}}function Sn(n,t){return n=+n,t=+t,function(e){return n*(1-e)+t*e}}function ex(n,t){var e={},i={},s;(n===null||typeof n!="object")&&(n={}),(t===null||typeof t!="object")&&(t={});for(s in t)s in n?e[s]=Ca(n[s],t[s]):i[s]=t[s];return function(r){for(s in e)i[s]=e[s](r);return i}}var Oc=/[-+]?(?:\d+\.?\d*|\.?\d+)(?:[eE][-+]?\d+)?/g,Fc=new RegExp(Oc.source,"g");function nx(n){return function(){return n}}function ix(n){return function(t){return n(t)+""}}function sx(n,t){var e=Oc.lastIndex=Fc.lastIndex=0,i,s,r,a=-1,o=[],l=[];for(n=n+"",t=t+"";(i=Oc.exec(n))&&(s=Fc.exec(t));)(r=s.index)>e&&(r=t.slice(e,r),o[a]?o[a]+=r:o[++a]=r),(i=i[0])===(s=s[0])?o[a]?o[a]+=s:o[++a]=s:(o[++a]=null,l.push({i:a,x:Sn(i,s)})),e=Fc.lastIndex;return e<t.length&&(r=t.slice(e),o[a]?o[a]+=r:o[++a]=r),o.length<2?l[0]?ix(l[0].x):nx(t):(t=l.length,function(c){for(var h=0,f;h<t;++h)o[(f=l[h]).i]=f.x(c);return o.join("")})}function Ca(n,t){var e=typeof t,i;return t==null||e==="boolean"?Ea(t):(e==="number"?Sn:e==="string"?(i=gs(t))?(t=i,Xf):sx:t instanceof gs?Xf:t instanceof Date?tx:j0(t)?K0:Array.isArray(t)?Q0:typeof t.valueOf!="function"&&typeof t.toString!="function"||isNaN(t)?ex:Sn)(n,t)}function Kf(n,t){return n=+n,t=+t,function(e){return Math.round(n*(1-e)+t*e)}}var qf=180/Math.PI,Bc={translateX:0,translateY:0,rotate:0,skewX:0,scaleX:1,scaleY:1};function jf(n,t,e,i,s,r){var a,o,l;return(a=Math.sqrt(n*n+t*t))&&(n/=a,t/=a),(l=n*e+t*i)&&(e-=n*l,i-=t*l),(o=Math.sqrt(e*e+i*i))&&(e/=o,i/=o,l/=o),n*i<t*e&&(n=-n,t=-t,l=-l,a=-a),{translateX:s,translateY:r,rotate:Math.atan2(t,n)*qf,skewX:Math.atan(l)*qf,scaleX:a,scaleY:o}}var Ta;function rx(n){let t=new(typeof DOMMatrix=="function"?DOMMatrix:WebKitCSSMatrix)(n+"");return t.isIdentity?Bc:jf(t.a,t.b,t.c,t.d,t.e,t.f)}function ax(n){return n==null||(Ta||(Ta=document.createElementNS("http://www.w3.org/2000/svg","g")),Ta.setAttribute("transform",n),!(n=Ta.transform.baseVal.consolidate()))?Bc:(n=n.matrix,jf(n.a,n.b,n.c,n.d,n.e,n.f))}function Qf(n,t,e,i){function s(c){return c.length?c.pop()+" ":""}function r(c,h,f,u,d,m){if(c!==f||h!==u){var _=d.push("translate(",null,t,null,e);m.push({i:_-4,x:Sn(c,f)},{i:_-2,x:Sn(h,u)})}else(f||u)&&d.push("translate("+f+t+u+e)}function a(c,h,f,u){c!==h?(c-h>180?h+=360:h-c>180&&(c+=360),u.push({i:f.push(s(f)+"rotate(",null,i)-2,x:Sn(c,h)})):h&&f.push(s(f)+"rotate("+h+i)}function o(c,h,f,u){c!==h?u.push({i:f.push(s(f)+"skewX(",null,i)-2,x:Sn(c,h)}):h&&f.push(s(f)+"skewX("+h+i)}function l(c,h,f,u,d,m){if(c!==f||h!==u){var _=d.push(s(d)+"scale(",null,",",null,")");m.push({i:_-4,x:Sn(c,f)},{i:_-2,x:Sn(h,u)})}else(f!==1||u!==1)&&d.push(s(d)+"scale("+f+","+u+")")}return function(c,h){var f=[],u=[];return c=n(c),h=n(h),r(c.translateX,c.translateY,h.translateX,h.translateY,f,u),a(c.rotate,h.rotate,f,u),o(c.skewX,h.skewX,f,u),l(c.scaleX,c.scaleY,h.scaleX,h.scaleY,f,u),c=h=null,function(d){for(var m=-1,_=u.length,p;++m<_;)f[(p=u[m]).i]=p.x(d);return f.join("")}}}var rA=Qf(rx,"px, ","px)","deg)"),aA=Qf(ax,", ",")",")"),ox=1e-12;function $f(n){return((n=Math.exp(n))+1/n)/2}function lx(n){return((n=Math.exp(n))-1/n)/2}function cx(n){return((n=Math.exp(2*n))-1)/(n+1)}var oA=(function n(t,e,i){function s(r,a){var o=r[0],l=r[1],c=r[2],h=a[0],f=a[1],u=a[2],d=h-o,m=f-l,_=d*d+m*m,p,g;if(_<ox)g=Math.log(u/c)/t,p=function(x){return[o+x*d,l+x*m,c*Math.exp(t*x*g)]};else{var M=Math.sqrt(_),A=(u*u-c*c+i*_)/(2*c*e*M),b=(u*u-c*c-i*_)/(2*u*e*M),E=Math.log(Math.sqrt(A*A+1)-A),S=Math.log(Math.sqrt(b*b+1)-b);g=(S-E)/t,p=function(x){var w=x*g,O=$f(E),P=c/(e*M)*(O*cx(t*w+E)-lx(E));return[o+P*d,l+P*m,c*O/$f(t*w+E)]}}return p.duration=Math.abs(g)*1e3*t/Math.SQRT2,p}return s.rho=function(r){var a=Math.max(.001,+r),o=a*a,l=o*o;return n(a,o,l)},s})(Math.SQRT2,2,4);function td(n){return function(t,e){var i=n((t=Ma(t)).h,(e=Ma(e)).h),s=je(t.s,e.s),r=je(t.l,e.l),a=je(t.opacity,e.opacity);return function(o){return t.h=i(o),t.s=s(o),t.l=r(o),t.opacity=a(o),t+""}}}var lA=td(kc),cA=td(je);function ed(n){return function(t,e){var i=n((t=Sa(t)).h,(e=Sa(e)).h),s=je(t.c,e.c),r=je(t.l,e.l),a=je(t.opacity,e.opacity);return function(o){return t.h=i(o),t.c=s(o),t.l=r(o),t.opacity=a(o),t+""}}}var hA=ed(kc),uA=ed(je);function nd(n){return(function t(e){e=+e;function i(s,r){var a=n((s=Aa(s)).h,(r=Aa(r)).h),o=je(s.s,r.s),l=je(s.l,r.l),c=je(s.opacity,r.opacity);return function(h){return s.h=a(h),s.s=o(h),s.l=l(Math.pow(h,e)),s.opacity=c(h),s+""}}return i.gamma=t,i})(1)}var fA=nd(kc),dA=nd(je);function hx(n){return Math.abs(n=Math.round(n))>=1e21?n.toLocaleString("en").replace(/,/g,""):n.toString(10)}function Ia(n,t){if(!isFinite(n)||n===0)return null;var e=(n=t?n.toExponential(t-1):n.toExponential()).indexOf("e"),i=n.slice(0,e);return[i.length>1?i[0]+i.slice(2):i,+n.slice(e+1)]}function xs(n){return n=Ia(Math.abs(n)),n?n[1]:NaN}function ux(n,t){return function(e,i){for(var s=e.length,r=[],a=0,o=n[0],l=0;s>0&&o>0&&(l+o+1>i&&(o=Math.max(1,i-l)),r.push(e.substring(s-=o,s+o)),!((l+=o+1)>i));)o=n[a=(a+1)%n.length];return r.reverse().join(t)}}function fx(n){return function(t){return t.replace(/[0-9]/g,function(e){return n[+e]})}}var dx=/^(?:(.)?([<>=^]))?([+\-( ])?([$#])?(0)?(\d+)?(,)?(\.\d+)?(~)?([a-z%])?$/i;function _s(n){if(!(t=dx.exec(n)))throw new Error("invalid format: "+n);var t;return new zc({fill:t[1],align:t[2],sign:t[3],symbol:t[4],zero:t[5],width:t[6],comma:t[7],precision:t[8]&&t[8].slice(1),trim:t[9],type:t[10]})}_s.prototype=zc.prototype;function zc(n){this.fill=n.fill===void 0?" ":n.fill+"",this.align=n.align===void 0?">":n.align+"",this.sign=n.sign===void 0?"-":n.sign+"",this.symbol=n.symbol===void 0?"":n.symbol+"",this.zero=!!n.zero,this.width=n.width===void 0?void 0:+n.width,this.comma=!!n.comma,this.precision=n.precision===void 0?void 0:+n.precision,this.trim=!!n.trim,this.type=n.type===void 0?"":n.type+""}zc.prototype.toString=function(){return this.fill+this.align+this.sign+this.symbol+(this.zero?"0":"")+(this.width===void 0?"":Math.max(1,this.width|0))+(this.comma?",":"")+(this.precision===void 0?"":"."+Math.max(0,this.precision|0))+(this.trim?"~":"")+this.type};function px(n){t:for(var t=n.length,e=1,i=-1,s;e<t;++e)switch(n[e]){case".":i=s=e;break;case"0":i===0&&(i=e),s=e;break;default:if(!+n[e])break t;i>0&&(i=0);break}return i>0?n.slice(0,i)+n.slice(s+1):n}var Pa;function mx(n,t){var e=Ia(n,t);if(!e)return Pa=void 0,n.toPrecision(t);var i=e[0],s=e[1],r=s-(Pa=Math.max(-8,Math.min(8,Math.floor(s/3)))*3)+1,a=i.length;return r===a?i:r>a?i+new Array(r-a+1).join("0"):r>0?i.slice(0,r)+"."+i.slice(r):"0."+new Array(1-r).join("0")+Ia(n,Math.max(0,t+r-1))[0]}function id(n,t){var e=Ia(n,t);if(!e)return n+"";var i=e[0],s=e[1];return s<0?"0."+new Array(-s).join("0")+i:i.length>s+1?i.slice(0,s+1)+"."+i.slice(s+1):i+new Array(s-i.length+2).join("0")}var sd={"%":(n,t)=>(n*100).toFixed(t),b:n=>Math.round(n).toString(2),c:n=>n+"",d:hx,e:(n,t)=>n.toExponential(t),f:(n,t)=>n.toFixed(t),g:(n,t)=>n.toPrecision(t),o:n=>Math.round(n).toString(8),p:(n,t)=>id(n*100,t),r:id,s:mx,X:n=>Math.round(n).toString(16).toUpperCase(),x:n=>Math.round(n).toString(16)};function rd(n){return n}var ad=Array.prototype.map,od=["y","z","a","f","p","n","\xB5","m","","k","M","G","T","P","E","Z","Y"];function gx(n){var t=n.grouping===void 0||n.thousands===void 0?rd:ux(ad.call(n.grouping,Number),n.thousands+""),e=n.currency===void 0?"":n.currency[0]+"",i=n.currency===void 0?"":n.currency[1]+"",s=n.decimal===void 0?".":n.decimal+"",r=n.numerals===void 0?rd:fx(ad.call(n.numerals,String)),a=n.percent===void 0?"%":n.percent+"",o=n.minus===void 0?"\u2212":n.minus+"",l=n.nan===void 0?"NaN":n.nan+"";function c(f,u){f=_s(f);var d=f.fill,m=f.align,_=f.sign,p=f.symbol,g=f.zero,M=f.width,A=f.comma,b=f.precision,E=f.trim,S=f.type;S==="n"?(A=!0,S="g"):sd[S]||(b===void 0&&(b=12),E=!0,S="g"),(g||d==="0"&&m==="=")&&(g=!0,d="0",m="=");var x=(u&&u.prefix!==void 0?u.prefix:"")+(p==="$"?e:p==="#"&&/[boxX]/.test(S)?"0"+S.toLowerCase():""),w=(p==="$"?i:/[%p]/.test(S)?a:"")+(u&&u.suffix!==void 0?u.suffix:""),O=sd[S],P=/[defgprs%]/.test(S);b=b===void 0?6:/[gprs]/.test(S)?Math.max(1,Math.min(21,b)):Math.max(0,Math.min(20,b));function D(N){var V=x,I=w,W,Y,G;if(S==="c")I=O(N)+I,N="";else{N=+N;var tt=N<0||1/N<0;if(N=isNaN(N)?l:O(Math.abs(N),b),E&&(N=px(N)),tt&&+N==0&&_!=="+"&&(tt=!1),V=(tt?_==="("?_:o:_==="-"||_==="("?"":_)+V,I=(S==="s"&&!isNaN(N)&&Pa!==void 0?od[8+Pa/3]:"")+I+(tt&&_==="("?")":""),P){for(W=-1,Y=N.length;++W<Y;)if(G=N.charCodeAt(W),48>G||G>57){I=(G===46?s+N.slice(W+1):N.slice(W))+I,N=N.slice(0,W);break}}}A&&!g&&(N=t(N,1/0));var X=V.length+N.length+I.length,j=X<M?new Array(M-X+1).join(d):"";switch(A&&g&&(N=t(j+N,j.length?M-I.length:1/0),j=""),m){case"<":N=V+N+I+j;break;case"=":N=V+j+N+I;break;case"^":N=j.slice(0,X=j.length>>1)+V+N+I+j.slice(X);break;default:N=j+V+N+I;break}return r(N)}return D.toString=function(){return f+""},D}function h(f,u){var d=Math.max(-8,Math.min(8,Math.floor(xs(u)/3)))*3,m=Math.pow(10,-d),_=c((f=_s(f),f.type="f",f),{suffix:od[8+d/3]});return function(p){return _(m*p)}}return{format:c,formatPrefix:h}}var Ra,La,Vc;xx({thousands:",",grouping:[3],currency:["$",""]});function xx(n){return Ra=gx(n),La=Ra.format,Vc=Ra.formatPrefix,Ra}function ld(n){return Math.max(0,-xs(Math.abs(n)))}function cd(n,t){return Math.max(0,Math.max(-8,Math.min(8,Math.floor(xs(t)/3)))*3-xs(Math.abs(n)))}function hd(n,t){return n=Math.abs(n),t=Math.abs(t)-n,Math.max(0,xs(t)-xs(n))+1}function Na(n,t){switch(arguments.length){case 0:break;case 1:this.range(n);break;default:this.range(t).domain(n);break}return this}var ud=Symbol("implicit");function gd(){var n=new ur,t=[],e=[],i=ud;function s(r){let a=n.get(r);if(a===void 0){if(i!==ud)return i;n.set(r,a=t.push(r)-1)}return e[a%e.length]}return s.domain=function(r){if(!arguments.length)return t.slice();t=[],n=new ur;for(let a of r)n.has(a)||n.set(a,t.push(a)-1);return s},s.range=function(r){return arguments.length?(e=Array.from(r),s):e.slice()},s.unknown=function(r){return arguments.length?(i=r,s):i},s.copy=function(){return gd(t,e).unknown(i)},Na.apply(s,arguments),s}function xd(){var n=gd().unknown(void 0),t=n.domain,e=n.range,i=0,s=1,r,a,o=!1,l=0,c=0,h=.5;delete n.unknown;function f(){var u=t().length,d=s<i,m=d?s:i,_=d?i:s;r=(_-m)/Math.max(1,u-l+c*2),o&&(r=Math.floor(r)),m+=(_-m-r*(u-l))*h,a=r*(1-l),o&&(m=Math.round(m),a=Math.round(a));var p=bf(u).map(function(g){return m+r*g});return e(d?p.reverse():p)}return n.domain=function(u){return arguments.length?(t(u),f()):t()},n.range=function(u){return arguments.length?([i,s]=u,i=+i,s=+s,f()):[i,s]},n.rangeRound=function(u){return[i,s]=u,i=+i,s=+s,o=!0,f()},n.bandwidth=function(){return a},n.step=function(){return r},n.round=function(u){return arguments.length?(o=!!u,f()):o},n.padding=function(u){return arguments.length?(l=Math.min(1,c=+u),f()):l},n.paddingInner=function(u){return arguments.length?(l=Math.min(1,u),f()):l},n.paddingOuter=function(u){return arguments.length?(c=+u,f()):c},n.align=function(u){return arguments.length?(h=Math.max(0,Math.min(1,u)),f()):h},n.copy=function(){return xd(t(),[i,s]).round(o).paddingInner(l).paddingOuter(c).align(h)},Na.apply(f(),arguments)}function _d(n){var t=n.copy;return n.padding=n.paddingOuter,delete n.paddingInner,delete n.paddingOuter,n.copy=function(){return _d(t())},n}function yd(){return _d(xd.apply(null,arguments).paddingInner(1))}function _x(n){return function(){return n}}function yx(n){return+n}var fd=[0,1];function ys(n){return n}function Gc(n,t){return(t-=n=+n)?function(e){return(e-n)/t}:_x(isNaN(t)?NaN:.5)}function vx(n,t){var e;return n>t&&(e=n,n=t,t=e),function(i){return Math.max(n,Math.min(t,i))}}function bx(n,t,e){var i=n[0],s=n[1],r=t[0],a=t[1];return s<i?(i=Gc(s,i),r=e(a,r)):(i=Gc(i,s),r=e(r,a)),function(o){return r(i(o))}}function Mx(n,t,e){var i=Math.min(n.length,t.length)-1,s=new Array(i),r=new Array(i),a=-1;for(n[i]<n[0]&&(n=n.slice().reverse(),t=t.slice().reverse());++a<i;)s[a]=Gc(n[a],n[a+1]),r[a]=e(t[a],t[a+1]);return function(o){var l=xf(n,o,1,i)-1;return r[l](s[l](o))}}function vd(n,t){return t.domain(n.domain()).range(n.range()).interpolate(n.interpolate()).clamp(n.clamp()).unknown(n.unknown())}function bd(){var n=fd,t=fd,e=Ca,i,s,r,a=ys,o,l,c;function h(){var u=Math.min(n.length,t.length);return a!==ys&&(a=vx(n[0],n[u-1])),o=u>2?Mx:bx,l=c=null,f}function f(u){return u==null||isNaN(u=+u)?r:(l||(l=o(n.map(i),t,e)))(i(a(u)))}return f.invert=function(u){return a(s((c||(c=o(t,n.map(i),Sn)))(u)))},f.domain=function(u){return arguments.length?(n=Array.from(u,yx),h()):n.slice()},f.range=function(u){return arguments.length?(t=Array.from(u),h()):t.slice()},f.rangeRound=function(u){return t=Array.from(u),e=Kf,h()},f.clamp=function(u){return arguments.length?(a=u?!0:ys,h()):a!==ys},f.interpolate=function(u){return arguments.length?(e=u,h()):e},f.unknown=function(u){return arguments.length?(r=u,f):r},function(u,d){return i=u,s=d,h()}}function Sx(){return bd()(ys,ys)}function wx(n,t,e,i){var s=vf(n,t,e),r;switch(i=_s(i??",f"),i.type){case"s":{var a=Math.max(Math.abs(n),Math.abs(t));return i.precision==null&&!isNaN(r=cd(s,a))&&(i.precision=r),Vc(i,a)}case"":case"e":case"g":case"p":case"r":{i.precision==null&&!isNaN(r=hd(s,Math.max(Math.abs(n),Math.abs(t))))&&(i.precision=r-(i.type==="e"));break}case"f":case"%":{i.precision==null&&!isNaN(r=ld(s))&&(i.precision=r-(i.type==="%")*2);break}}return La(i)}function Ax(n){var t=n.domain;return n.ticks=function(e){var i=t();return xa(i[0],i[i.length-1],e??10)},n.tickFormat=function(e,i){var s=t();return wx(s[0],s[s.length-1],e??10,i)},n.nice=function(e){e==null&&(e=10);var i=t(),s=0,r=i.length-1,a=i[s],o=i[r],l,c,h=10;for(o<a&&(c=a,a=o,o=c,c=s,s=r,r=c);h-- >0;){if(c=ga(a,o,e),c===l)return i[s]=a,i[r]=o,t(i);if(c>0)a=Math.floor(a/c)*c,o=Math.ceil(o/c)*c;else if(c<0)a=Math.ceil(a*c)/c,o=Math.floor(o*c)/c;else break;l=c}return n},n}function Da(){var n=Sx();return n.copy=function(){return vd(n,Da())},Na.apply(n,arguments),Ax(n)}function Tx(n,t){n=n.slice();var e=0,i=n.length-1,s=n[e],r=n[i],a;return r<s&&(a=e,e=i,i=a,a=s,s=r,r=a),n[e]=t.floor(s),n[i]=t.ceil(r),n}function dd(n){return Math.log(n)}function pd(n){return Math.exp(n)}function Ex(n){return-Math.log(-n)}function Cx(n){return-Math.exp(-n)}function Rx(n){return isFinite(n)?+("1e"+n):n<0?0:n}function Ix(n){return n===10?Rx:n===Math.E?Math.exp:t=>Math.pow(n,t)}function Px(n){return n===Math.E?Math.log:n===10&&Math.log10||n===2&&Math.log2||(n=Math.log(n),t=>Math.log(t)/n)}function md(n){return(t,e)=>-n(-t,e)}function Lx(n){let t=n(dd,pd),e=t.domain,i=10,s,r;function a(){return s=Px(i),r=Ix(i),e()[0]<0?(s=md(s),r=md(r),n(Ex,Cx)):n(dd,pd),t}return t.base=function(o){return arguments.length?(i=+o,a()):i},t.domain=function(o){return arguments.length?(e(o),a()):e()},t.ticks=o=>{let l=e(),c=l[0],h=l[l.length-1],f=h<c;f&&([c,h]=[h,c]);let u=s(c),d=s(h),m,_,p=o==null?10:+o,g=[];if(!(i%1)&&d-u<p){if(u=Math.floor(u),d=Math.ceil(d),c>0){for(;u<=d;++u)for(m=1;m<i;++m)if(_=u<0?m/r(-u):m*r(u),!(_<c)){if(_>h)break;g.push(_)}}else for(;u<=d;++u)for(m=i-1;m>=1;--m)if(_=u>0?m/r(-u):m*r(u),!(_<c)){if(_>h)break;g.push(_)}g.length*2<p&&(g=xa(c,h,p))}else g=xa(u,d,Math.min(d-u,p)).map(r);return f?g.reverse():g},t.tickFormat=(o,l)=>{if(o==null&&(o=10),l==null&&(l=i===10?"s":","),typeof l!="function"&&(!(i%1)&&(l=_s(l)).precision==null&&(l.trim=!0),l=La(l)),o===1/0)return l;let c=Math.max(1,i*o/t.ticks().length);return h=>{let f=h/r(Math.round(s(h)));return f*i<i-.5&&(f*=i),f<=c?l(h):""}},t.nice=()=>e(Tx(e(),{floor:o=>r(Math.floor(s(o))),ceil:o=>r(Math.ceil(s(o)))})),t}function Hc(){let n=Lx(bd()).domain([1,10]);return n.copy=()=>vd(n,Hc()).base(n.base()),Na.apply(n,arguments),n}function Jn(n,t,e,i,s=64){if(n==="band"){let l=yd(t,e).padding(.6);return{kind:n,scale:l,ticks:t,text:c=>String(c)}}let r=(n==="linear"?Da():Hc()).domain(t).range(e),a=Math.max(2,Math.floor(Math.abs(e[1]-e[0])/s)),o=i?.filter(l=>l>=t[0]&&l<=t[1]);return o&&o.length>1&&o.length<=24?{kind:n,scale:r,ticks:Md(o,r,s*.55),text:Sd}:n==="linear"?{kind:n,scale:r,ticks:r.ticks(a),text:Sd}:{kind:n,scale:r,ticks:Md(Dx(t,a),r,s*.55),text:wd}}var Ua=160,Fa=560,Nx=1e-6;function vs(n,t,e=.06,i=!0){let s=n.filter(l=>Number.isFinite(l)&&(!t||l>0));if(!s.length)return t?[.1,1]:[0,1];let r=Math.min(...s),a=Math.max(...s);if(t){r=Math.max(r,a*Nx);let l=Math.max((a/r)**e,r===a?1.5:1.02);return[r/l,a*l]}let o=(a-r)*e||Math.abs(a)*.1||.5;return i&&r>=0&&r-o<.25*a?[0,a+o]:[r-o,a+o]}function Dx([n,t],e){let i=Math.log10(t/n),s=(l,c)=>i<Math.min(l,c*e),r=s(1.4,.28)?[1,2,3,5,7]:s(3,.55)?[1,2,5]:[1],a=Math.max(1,Math.ceil(i/e)),o=[];for(let l=Math.floor(Math.log10(n));l<=Math.ceil(Math.log10(t));++l)if(!(r.length===1&&l%a))for(let c of r){let h=c*10**l;h>=n*.9999&&h<=t*1.0001&&o.push(Number(h.toPrecision(1)))}return o.length>=2?o:Da().domain([n,t]).ticks(e)}function Md(n,t,e){let i=[];for(let s of[...n].sort((r,a)=>r-a))(!i.length||Math.abs(t(s)-t(i.at(-1)))>=e)&&i.push(s);return i}function Sd(n){let t=Math.abs(n);return t>=1e5||t>0&&t<.001?wd(n):Ln(String(Number(n.toPrecision(6))))}function wd(n){if(n>=.001&&n<1e5)return Ln(String(Number(n.toPrecision(3))));let[t,e]=n.toExponential(2).split("e").map(Number);return t===1?`10${oa(e)}`:`${Ln(String(t))}\xB710${oa(e)}`}var Oa=28,Ba=class{constructor(t,e){this.chart=e,this.shares=!1,this.legend=new cs(e.parts,"bar",()=>this.draw(),()=>{});let i=ca("Shares",!1,r=>{this.shares=r,this.draw()},"Each bar as shares of its whole"),s=e.rows.some(({runs:r})=>r?.length)?", Enter opens the run":"";this.plot=C("div",{class:"plot",role:"group","aria-roledescription":"chart",tabindex:0,"aria-label":`${e.title}. Arrow keys go from part to part${s}.`}),this.tip=C("div",{class:"tip",role:"status",hidden:!0}),t.append(C("div",{class:"tools"},i,ha(e)),C("div",{class:"chart-body"},this.legend.element,this.plot)),this.plot.addEventListener("keydown",r=>this.#n(r)),this.plot.addEventListener("pointerleave",()=>this.#e(null)),this.plot.addEventListener("blur",()=>this.#e(null)),new ResizeObserver(()=>this.draw()).observe(this.plot)}draw(){let t=this.paper??this.plot.clientWidth;if(t<Ua)return;let{rows:e,parts:i,x:s}=this.chart,r=i.map(g=>!this.legend.hidden.has(g.label)),a=e.map(g=>Ux(g.values.filter((M,A)=>r[A]))),o=t<Fa,l=o?Oa+Nn:Oa,c=s.rows?26:4,h=o?17:0,f=o?4:Math.min(Math.max(...e.map(g=>g.label.length))*7.2+14,t*.42),u=c+4+e.length*l,d={left:f,right:t-64,top:c,bottom:u},m=this.shares?1:Math.max(...a)||1,_=Jn("linear",[0,m],[f,d.right],null,80);this.shares&&(_.text=g=>`${Math.round(100*g)} %`);let p=u+46;this.picture=Tt("svg",{class:"picture bars",width:t,height:p,viewBox:`0 0 ${t} ${p}`},la(_,d,[this.shares?"share":ci(s.label,s.unit)],!0),s.rows&&Tt("text",{class:"title",x:0,y:12},s.rows)),this.cells=[],e.forEach((g,M)=>{let A=c+4+M*l+h,b=this.shares?1/(a[M]||1):1,E=(o?t:f)/6.9;this.picture.append(Tt("text",{class:"category",x:o?f:f-8,y:o?A-2:A+16,"text-anchor":o?"start":"end"},g.label.length>E?`${g.label.slice(0,Math.floor(E)-1)}\u2026`:g.label));let S=0;g.values.forEach((x,w)=>{if(!r[w]||!(x>0))return;let O=_.scale(S*b),P=_.scale((S+x)*b);S+=x;let D=bn(Tt("rect",{class:"bar",x:O,y:A+3,width:Math.max(P-O-1,.5),height:Oa-10,onpointerenter:()=>this.#e(N),onclick:()=>this.#t(N)}),i[w].look),N={row:g,r:M,part:i[w],value:x,sum:a[M],x:(O+P)/2,y:A+3,bar:D};this.cells.push(N),this.picture.append(D)}),this.shares||this.picture.append(Tt("text",{class:"sum",x:_.scale(S)+7,y:A+16},Vt(S)))}),this.plot.replaceChildren(this.picture,this.tip),this.#e(null)}#t(t){t?.row.runs?.length&&Ui(t.row.runs,this.plot)}#n(t){let e=this.cells.indexOf(this.pointed),i=s=>this.cells.find(r=>r.r===s);if(t.key==="ArrowRight")this.#e(this.cells[Math.min(e+1,this.cells.length-1)]);else if(t.key==="ArrowLeft")this.#e(this.cells[Math.max(e-1,0)]);else if(t.key==="ArrowDown")this.#e(i((this.pointed?.r??-1)+1)??this.pointed);else if(t.key==="ArrowUp")this.#e(i((this.pointed?.r??1)-1)??this.pointed);else if(t.key==="Enter")this.#t(this.pointed);else if(t.key==="Escape"&&this.pointed)this.#e(null);else return;t.preventDefault()}#e(t){if(this.pointed?.bar.classList.remove("pointed"),this.pointed=t,this.tip.hidden=!t,!t)return;t.bar.classList.add("pointed");let e=[[t.part.label,pn(t.value,this.chart.x.unit)],["share",`${Vt(100*t.value/t.sum)} %`],["whole bar",pn(t.sum,this.chart.x.unit)]];this.tip.replaceChildren(C("strong",{},t.row.label),C("dl",{},...e.flatMap(([r,a])=>[C("dt",{},r),C("dd",{},a)])));let i=this.tip.getBoundingClientRect(),s=this.plot.clientWidth-i.width;this.tip.style.left=`${Math.min(Math.max(0,t.x-i.width/2),s)}px`,this.tip.style.top=`${t.y+Oa}px`}},Ux=n=>n.reduce((t,e)=>t+(e>0?e:0),0);var ka=null,Wc=()=>ka;function za(n){ka=n&&new Set(n),document.dispatchEvent(new CustomEvent("bendlab:chosen"))}function bs(n){return document.addEventListener("bendlab:chosen",n),()=>document.removeEventListener("bendlab:chosen",n)}function fi(n){return!ka||!n.length||n.some(t=>ka.has(t))}function Ad(n,t){let e=null,i=null,s=()=>{let r=document.querySelector("main .player")?.player?.time;r===void 0||r===i||(i=r,t(r))};new IntersectionObserver(([r])=>{clearInterval(e),e=r.isIntersecting?setInterval(s,60):null}).observe(n)}var Fx=90,Va=class{constructor(t){this.owner=t,this.tip=C("div",{class:"tip",role:"status",hidden:!0}),this.cursor=Tt("g",{class:"cursor"}),this.#t()}renew(){this.cursor=Tt("g",{class:"cursor"}),this.owner.picture.append(this.cursor),this.owner.plot.append(this.tip),this.tip.hidden=!0,this.pointed=null}#t(){let{plot:t}=this.owner;t.addEventListener("pointermove",e=>this.#i(e)),t.addEventListener("pointerleave",()=>{this.dragged||this.#o(null)}),t.addEventListener("pointerdown",e=>this.#s(e)),t.addEventListener("pointerup",e=>this.#a(e)),t.addEventListener("pointercancel",()=>{this.dragged=null,this.#r()}),t.addEventListener("dblclick",()=>this.owner.zoom(null)),t.addEventListener("keydown",e=>this.#h(e)),t.addEventListener("blur",()=>this.#o(null))}#n(t){let e=this.owner.plot.getBoundingClientRect();return[t.clientX-e.left,t.clientY-e.top]}#e(){return(this.owner.shown??[]).flatMap(({points:t})=>t).filter(t=>t.at[0]>=this.owner.box.left-2&&t.at[0]<=this.owner.box.right+2)}#i(t){if(!this.owner.box)return;let e=this.#n(t);if(this.dragged){this.dragged.to=e[0],this.#r();return}let i=this.owner.chart.x.name==="time"?4:1,s=null,r=Fx**2;for(let a of this.#e()){let o=(i*(a.at[0]-e[0]))**2+(a.at[1]-e[1])**2;o<r&&([s,r]=[a,o])}this.#o(s)}#s(t){if(t.button!==0||t.pointerType==="touch"||this.owner.bands||!this.owner.box)return;let[e]=this.#n(t);e<this.owner.box.left||e>this.owner.box.right||(this.dragged={from:e,to:e},this.owner.plot.setPointerCapture(t.pointerId))}#a(t){let e=this.dragged;if(this.dragged=null,this.#r(),t.button===0)if(e&&Math.abs(e.to-e.from)>8){let i=r=>Math.min(Math.max(r,this.owner.box.left),this.owner.box.right),s=[e.from,e.to].sort((r,a)=>r-a).map(r=>this.owner.place.scale.invert(i(r)));this.owner.zoom(s)}else this.pointed?.runs.length&&Ui(this.pointed.runs,this.owner.plot)}#r(){if(this.band?.remove(),!this.dragged||Math.abs(this.dragged.to-this.dragged.from)<3)return;let[t,e]=[this.dragged.from,this.dragged.to].sort((i,s)=>i-s);this.band=Tt("rect",{class:"brush",x:t,width:e-t,y:this.owner.box.top,height:this.owner.box.bottom-this.owner.box.top}),this.owner.picture.append(this.band)}#l(t){if(this.owner.bands)return;let{scale:e}=this.owner.place,{left:i,right:s}=this.owner.box,r=this.pointed?.at[0]??(i+s)/2,a=[r-(r-i)*t,r+(s-r)*t],o=t>1&&a[1]-a[0]>4*(s-i),l=this.pointed;this.owner.zoom(o?null:a.map(c=>e.invert(c))),this.#o(l&&this.#e().find(c=>c.series===l.series&&c.i===l.i)||null)}#h(t){let e=t.key;if(e==="+"||e==="=")this.#l(.6);else if(e==="-")this.#l(1/.6);else if(e==="0")this.owner.zoom(null);else if(e==="Enter"&&this.pointed?.runs.length)Ui(this.pointed.runs,this.owner.plot);else if(e==="Escape"&&this.pointed)this.#o(null);else if(e.startsWith("Arrow"))this.#c(e);else return;t.preventDefault()}#c(t){let e=this.owner.bands?["ArrowDown","ArrowUp"]:["ArrowRight","ArrowLeft"],i=this.owner.shown.map(({points:h})=>h).filter(h=>h.length);if(!i.length)return;let s=this.pointed;if(!s)return this.#o(i[0][0]);let r=i.findIndex(h=>h.includes(s)),a=i[r]??i[0],o=e.indexOf(t);if(o>=0){let h=a.indexOf(s)+(o===0?1:-1);return this.#o(a[Math.min(Math.max(h,0),a.length-1)])}let l=i.flatMap(h=>h.filter(f=>f.x===s.x)).sort((h,f)=>this.owner.bands?h.at[0]-f.at[0]:f.at[1]-h.at[1]),c=l.indexOf(s)+(t==="ArrowUp"||t==="ArrowRight"?1:-1);this.#o(l[Math.min(Math.max(c,0),l.length-1)])}#o(t){if(this.pointed=t,this.cursor?.replaceChildren(),this.owner.plot.classList.toggle("opens-run",!!t?.runs.length),this.tip.hidden=!t,!t)return;let e=Tt("circle",{class:"ring",cx:t.at[0],cy:t.at[1],r:8});this.cursor.append(bn(e,t.series.look)),this.tip.replaceChildren(...this.#u(t));let i=this.owner.plot.clientWidth,s=this.tip.getBoundingClientRect(),r=t.at[0]+16+s.width>i?t.at[0]-16-s.width:t.at[0]+16;this.tip.style.left=`${Math.max(0,r)}px`,this.tip.style.top=`${Math.max(0,t.at[1]-s.height/2)}px`}#u(t){let{chart:e,y:i}=this.owner,s=this.owner.bands?e.x.categories[t.x]:Ox(t.x,e.x.unit),r=[C("strong",{},os(t.series.look,this.owner.bands?"mark":"line"),t.series.label)],a=[[i.label,Number.isFinite(t.y)?pn(t.y,i.unit,4):"diverged"]];return t.low!==t.high&&a.push(["from, to",`${Vt(t.low,4)}, ${Vt(t.high,4)}`]),a.push([e.x.label,s]),t.runs.length>1&&a.push(["runs",String(t.runs.length)]),r.push(C("dl",{},...a.flatMap(([o,l])=>[C("dt",{},o),C("dd",{},l)]))),r}};function Ox(n,t){let e=Math.abs(n)>=1e5||n!==0&&Math.abs(n)<.001?Vt(n):Ln(String(Number(n.toPrecision(5))));return t&&t!=="1"?`${e}\u202F${t}`:e}function Xc(n,{metric:t,held:e,hidden:i}){let s=n.ys[t].name;return n.series.filter(r=>!i.has(r.label)&&r.y[s]).filter(r=>(r.held??[]).every((a,o)=>a===null||a===e[o])).map(r=>({series:r,points:r.x.map((a,o)=>Bx(r,s,a,o)).filter(a=>!Number.isNaN(a.y))})).filter(({points:r})=>r.length)}function Bx(n,t,e,i){let s=Ke(n.y[t][i]),r=o=>{let l=Ke(o?.[t]?.[i]);return Number.isNaN(l)?s:l},a=n.runs?.[i]??(n.run?[n.run]:[]);return{series:n,i,x:e,y:s,low:r(n.low),high:r(n.high),runs:a}}var kx=430,zx=80,Vx=0,Ms=class{constructor(t,e){this.figure=t,this.chart=e,this.id=`chart-${++Vx}`,this.bands=e.x.scale==="band",this.state={metric:e.choice??0,held:(e.held??[]).map(i=>i.at),zoom:null,log:!1},this.#t(),this.#n(),this.resizes=new ResizeObserver(()=>this.draw()),this.resizes.observe(this.plot)}dispose(){this.resizes.disconnect(),this.ignoreChosen()}get y(){return this.chart.ys[this.state.metric]}replace(t){Object.assign(this.chart,t),this.draw()}#t(){let{chart:t,state:e}=this,i=new Map(t.series.map(o=>[o.label,o]));this.legend=new cs([...i.values()],this.bands?"mark":"line",()=>this.draw(),o=>this.#M(o)),this.log=ca("Log",!1,o=>{e.log=o,this.draw()},"Logarithmic axis of the values"),this.reset=Ge("Reset zoom",()=>this.zoom(null),{hidden:!0});let s=C("div",{class:"tools"},t.ys.length>1&&Dn("Show",t.ys.map(o=>o.label),e.metric,o=>{e.metric=o,this.#n(),this.draw()}),...(t.held??[]).map((o,l)=>Dn(o.label,o.values,o.at,c=>{e.held[l]=c,this.draw()})),this.reset,this.log,ha(t)),a=`point to point${t.series.some(({run:o,runs:l})=>o||l?.some(c=>c.length))?", Enter opens the run":""}${this.bands?"":", + and - zoom"}`;this.plot=C("div",{class:"plot",tabindex:0,role:"group","aria-roledescription":"chart","aria-label":`${t.title}. Arrow keys go from ${a}.`}),this.meaning=C("p",{class:"meaning"}),this.body=C("div",{class:"chart-body"},i.size>1&&t.legend!==!1&&this.legend.element,this.plot),this.figure.append(s,this.body,this.meaning),this.pointing=new Va(this),this.ignoreChosen=bs(()=>this.#p()),t.x.name==="time"&&Ad(this.figure,o=>this.#S(o))}#n(){let t=Xc(this.chart,{...this.state,hidden:new Set}).flatMap(({points:a})=>a.map(o=>o.y)).filter(Number.isFinite).sort((a,o)=>a-o),e=t.length>0&&t[0]>=0&&t.at(-1)>0,i=a=>t[Math.round(a*(t.length-1))];this.log.disabled=!e;let s=i(t.length<20?0:.05),{y_scale:r}=this.chart;this.state.log=e&&(r?r==="log":s>0&&i(1)/s>30),this.log.setAttribute("aria-pressed",this.state.log)}draw(){let t=this.paper??this.plot.clientWidth;if(t<Ua)return;let{chart:e}=this;this.above=this.bands&&t<Fa,this.shown=Xc(e,{...this.state,hidden:this.legend.hidden}),this.meaning.textContent=this.y.meaning??"",this.#r();let i=[this.y,e.x].map(({label:M,unit:A})=>or(ci(M,A),(t-40)/dc));this.bands&&i.reverse();let[s,r]=i.map(M=>Nn*(M.length-1)),a=this.#e(t),o=this.bands&&a>kx?36+r+(this.above?Nn:0):0,l=this.#o();for(let M of l)M.lines=or(M.text,t/dc/(this.bands?2:1));let c=this.bands?Nn*Math.max(0,...l.map(({lines:M})=>M.length-1)):0,h=a+o+s+r+c,f=!this.paper&&this.#i(t,h),u={left:this.above?8:this.bands?this.#a(t):54,right:t-(f?this.legend.width+34:0)-14,top:26+s+o+c,bottom:h-48-r};this.#h(u),this.picture=Tt("svg",{class:"picture",width:t,height:h,viewBox:`0 0 ${t} ${h}`});let[d,m]=this.#m(u),[_,p]=[this.value,this.place],g=[zu(this.bands?p:_,u,i[0],this.above),la(this.bands?_:p,u,i[1],this.bands)];this.bands&&g.reverse(),this.picture.append(g[0],...d,g[1],...o?[Bu(_,u,i[1],u.top-c-20)]:[],...this.#g(u),...m),this.shown.length||this.picture.append(Tt("text",{class:"empty",x:(u.left+u.right)/2,y:(u.top+u.bottom)/2,"text-anchor":"middle"},"No run has this metric")),this.plot.replaceChildren(this.picture),this.box=u,this.pointing.renew(),this.#p(),f?this.#b(u):this.legend.flow()}#e(t){if(!this.bands)return Math.max(300,Math.min(430,t*.5));let e=Math.max(27,14+this.#l()*(this.#f()?13:6))+(this.above?Nn:0);return Math.max(150,74+this.#s().length*e)}#i(t,e){return!this.bands&&this.chart.legend!==!1&&t>=620&&this.legend.buttons.size>1&&this.legend.width+34<=.32*t&&this.legend.fits(e-74)}#s(){let t=this.chart.x.categories.map((i,s)=>s);if(!this.chart.held?.length)return t;let e=new Set(this.shown.flatMap(({points:i})=>i.map(s=>s.x)));return e.size?t.filter(i=>e.has(i)):t}#a(t){let e=this.#s().map(s=>String(this.chart.x.categories[s])),i=Math.max(...e.map(s=>s.length));return Math.min(i*7.8+16,t*.42)}#r(){this.neighbours=new Map,this.chart.dodge!==!1&&this.shown.forEach(({points:t},e)=>{for(let{x:i}of t){let s=this.neighbours.get(i)??[];s.includes(e)||s.push(e),this.neighbours.set(i,s)}})}#l(){return Math.max(1,...[...this.neighbours.values()].map(t=>t.length))}#h(t){let{chart:e,state:i}=this,r=this.shown.flatMap(({points:u})=>u).filter(u=>this.#c(u)).flatMap(u=>[u.y,u.low,u.high]),a=[...r];for(let u of this.#o())u.near=this.#u(u,a),u.near&&r.push(u.value);let o=this.bands?[t.left,t.right]:[t.bottom,t.top];if(this.value=Jn(i.log?"log":"linear",vs(r,i.log),o,null,this.bands?80:46),this.bands){this.place=Jn("band",this.#s(),[t.top,t.bottom]);let u=(this.above?t.right:t.left)/6.9;this.place.text=d=>Gx(e.x.categories[d],u);return}let l=e.x.scale,c=l!=="linear",h=e.series.flatMap(u=>u.x),f=i.zoom??(e.x.name==="time"?[Math.min(...h),Math.max(...h)]:vs(h,c,.05,!1));this.place=Jn(l,f[0]<f[1]?f:vs(h,c,.05,!1),[t.left,t.right],e.x.ticks)}#c({x:t}){let{zoom:e}=this.state;return!e||t>=e[0]&&t<=e[1]}#o(){return(this.chart.limits??[]).filter(e=>e.metric===this.y.name).filter(e=>!this.state.log||e.value>0)}#u(t,e){let i=e.filter(Number.isFinite).map(l=>this.state.log?Math.log(Math.max(l,1e-300)):l),s=this.state.log?Math.log(t.value):t.value,r=Math.min(...i),a=Math.max(...i),o=1.5*(a-r)||Math.abs(a)/2;return s<=a+o&&s>=r-o}#m(t){let e=0,i=[],s=[],r=(a,o,l,c)=>s.push(...rs(a,{class:"limit",x:o,y:l,"text-anchor":c}));for(let a of this.#o()){let o=this.value.scale(a.value);if(!a.near){let c=a.value>this.value.scale.domain()[1],h=` ${this.#d[Number(c)]}`,f=c?t.top-8+15*e++:t.bottom-7;r(a.lines.with(-1,a.lines.at(-1)+h),t.right,f,"end");continue}let l=this.bands?`M${o} ${t.top}V${t.bottom}`:`M${t.left} ${o}H${t.right}`;i.push(Tt("path",{class:"limit",d:l})),this.bands?2*o>t.left+t.right?r(a.lines,o-4,t.top-6,"end"):r(a.lines,o+4,t.top-6,"start"):r(a.lines,t.right,o-5,"end")}return[i,s]}get#d(){return this.bands?["\u2190","\u2192"]:["\u2193","\u2191"]}#g(t){let{chart:e}=this,i=`${this.id}-clip`,s=Tt("rect",{x:t.left-6,y:t.top-6,width:t.right-t.left+12,height:t.bottom-t.top+12}),r=this.shown.map((a,o)=>{for(let h of a.points)this.#x(h,o,t);let l=bn(Tt("g",{class:"series","clip-path":`url(#${i})`}),a.series.look),{line:c}=a.series;return!this.bands&&(c||e.joined!==!1)&&l.append(this.#_(a)),c||l.append(...this.#y(a),...this.#v(a)),a.drawn=l,l});return[Tt("clipPath",{id:i},s),...r]}#x(t,e,i){let s=this.bands?[i.left,i.right]:[i.bottom,i.top],r=this.#c(t)?this.value.scale.domain()[0]:0,a=d=>d===1/0?1:d===-1/0||this.state.log&&d<=r?0:null,o=d=>a(d)===null?this.value.scale(d):s[a(d)];t.arrow=this.#d[a(t.y)],t.ends=[t.low,t.high].map(d=>a(d)===null);let l=(this.bands?this.neighbours.get(t.x):[...this.shown.keys()])??[],c=l.length,h=this.chart.dodge===!1||c<2?0:(l.indexOf(e)-(c-1)/2)*(this.bands?Math.min(this.#f()?13:6,40/c):this.#f()?Math.min(4,24/c):0),f=this.place.scale(t.x)+h,u=d=>this.bands?[o(d),f]:[f,o(d)];t.at=u(t.y),t.from=u(t.low),t.to=u(t.high)}#f(){return this.shown.some(({points:t})=>t.some(e=>e.low!==e.high))}#_({series:t,points:e}){let i=da().x(s=>s.at[0]).y(s=>s.at[1]).defined(s=>!s.arrow);return Tt("path",{class:"line",d:i(e)??"","stroke-dasharray":t.look.dash})}#y({points:t}){let e=i=>this.bands?`M${i[0]} ${i[1]-3.5}v7`:`M${i[0]-3.5} ${i[1]}h7`;return t.filter(i=>i.low!==i.high).map(i=>Tt("path",{class:"range",d:`M${i.from}L${i.to}${i.ends[0]?e(i.from):""}${i.ends[1]?e(i.to):""}`}))}#v({series:t,points:e}){let s=!this.bands&&this.chart.joined!==!1&&e.length>45?Math.ceil(e.length/9):1;return e.filter((r,a)=>a%s===0).map(r=>{let a=`translate(${r.at}) rotate(${90*"\u2193\u2190\u2191\u2192".indexOf(r.arrow)})`;return r.drawn=r.arrow?Tt("path",{class:"beyond",d:"M0-10V0M-3.5-4L0 0L3.5-4",transform:a}):Ec(t.look,...r.at),r.drawn})}#p(){for(let{drawn:t,points:e}of this.shown??[]){for(let i of e)i.drawn?.classList.toggle("off",!fi(i.runs));t?.classList.toggle("off",e.every(i=>!fi(i.runs)))}}#b(t){let e=new Map;for(let{series:a,points:o}of this.shown){let l=o.filter(c=>c.at[0]<=t.right+1&&c.at[0]>=t.left-1);l.length&&e.set(a.label,l.at(-1).at)}let i=t.right+26,s=new Map([...e].map(([a,o])=>[a,Math.min(Math.max(o[1],t.top),t.bottom)])),r=this.legend.beside(s,i,t.top,t.bottom);for(let{series:a}of this.shown){let o=e.get(a.label);if(!o||this.chart.joined===!1&&!a.line)continue;let l=s.get(a.label),c=r.get(a.label);Math.max(t.right-o[0],Math.abs(l-c))>zx||this.picture.append(bn(Tt("path",{class:"leader",d:`M${o[0]+7} ${l}L${i-3} ${c}`}),a.look))}}#M(t){for(let{series:e,drawn:i}of this.shown??[])i?.classList.toggle("dim",t!==null&&t!==e.label&&!this.legend.hidden.has(t))}zoom(t){this.bands||(this.state.zoom=t,this.reset.hidden=!t,this.draw())}#S(t){if(!this.picture||!this.box)return;this.clock?.remove();let e=this.place.scale(t);e>=this.box.left&&e<=this.box.right&&(this.clock=Tt("path",{class:"clock",d:`M${e} ${this.box.top}V${this.box.bottom}`}),this.picture.append(this.clock))}};function Gx(n,t){let e=String(n);return e.length>t?`${e.slice(0,Math.max(3,Math.floor(t)-1))}\u2026`:e}var Hx=680;function Td(){let n=new Map((Xt().charts??[]).map(e=>[e.id,e]));for(let e of document.querySelectorAll("figure.chart[data-chart]")){let i=n.get(e.dataset.chart);i&&(e.classList.add("drawn"),e.chart=i.kind==="bars"?new Ba(e,i):new Ms(e,i))}let t=e=>{let i=document.querySelectorAll("figure.chart.drawn");for(let{chart:s}of i)Object.assign(s,{paper:e}).draw()};addEventListener("beforeprint",()=>t(Hx)),addEventListener("afterprint",()=>t(null))}function Cd(n){let t=new Map(Object.entries(Xt().settings?.[n.base??0]??{}));for(let[e,i]of Object.entries(n.changes??{}))i===null?t.delete(e):t.set(e,i[0]);return t}function Rd(n){let t=n.map(Cd);return[...new Set(t.flatMap(i=>[...i.keys()]))].filter(i=>new Set(t.map(s=>Ed(s.get(i)))).size>1).map(i=>({pointer:i,values:t.map(s=>Ed(s.get(i)))}))}function Ga(n){let t={};for(let[e,i]of Cd(n))Id(t,e.split("/").slice(1),i);return JSON.stringify(Pd(t),null,2)}function Id(n,t,e){let[i,...s]=t;s.length?Id(Object.hasOwn(n,i)?n[i]:n[i]={},s,e):Object.defineProperty(n,i,{value:e,enumerable:!0,configurable:!0,writable:!0})}function Pd(n){if(n===null||typeof n!="object"||Array.isArray(n))return n;let t=Object.keys(n),e=Object.fromEntries(t.map(i=>[i,Pd(n[i])]));return t.length&&t.every((i,s)=>i===String(s))?Object.values(e):e}function Ed(n){return n===void 0?"\u2013":typeof n=="string"?n:JSON.stringify(n)}function Nd(n,t){let e=[],i=n.runs.filter(h=>h.scene===t.scene);if(!i.length)return{best:null,fits:!1,others:[],notes:["No run was measured for this cloth."]};let s=i.filter(h=>h.family===t.family);s.length?i=s:e.push(`Accuracy was not measured on ${n.families[t.family]} in this scene. The answer is a run on ${[...new Set(i.map(h=>n.families[h.family]??h.family))].join(", ")}; ./bendlab advise CONFIG measures your own scene.`);let r=Xx(i.map(h=>h.cells),t.cells);r!==t.cells&&e.push(Wx(r,t.cells)),(r!==t.cells||t.matters!=="cost")&&(i=i.filter(h=>h.cells===r));let a=Math.max(...i.map(h=>h.unknown));t.goal==="error"&&t.most<a&&e.push(`Errors below ${a.toPrecision(2)} % are not known here: the reference is that far from a coarser reference.`);let o=[...qx(i)].map(h=>$x(h,t,a));o.sort((h,f)=>Yx(h,f,t,n));let[l,...c]=o;return{best:l.run,fits:l.fits,others:c.map(({run:h})=>h),notes:e}}function Wx(n,t){let e=(t/n)**2,i=e>=1?`about ${e.toPrecision(2)} times as`:`about ${e.toPrecision(2)} of this run's`;return`Nothing was measured on ${t} cells, so this run has ${n} cells. If time grows with the vertices, a step on ${t} cells takes ${i}${e>=1?" long":" time"}. The error there is not known${e>1?": finer meshes need more substeps":""}; ./bendlab advise CONFIG measures your scene.`}function Xx(n,t){let e=i=>Math.abs(Math.log(i/t));return n.reduce((i,s)=>e(s)<e(i)?s:i)}function qx(n){let t=new Map;for(let e of n){let i=`${e.model}, ${e.method}${e.paper?", paper":""}`;t.set(i,[...t.get(i)??[],e])}return t.values()}function $x(n,{goal:t,most:e},i){let[s,r]=t==="error"?["error","ms"]:["ms","error"],a=(l,c)=>l.reduce((h,f)=>f[c]<h[c]?f:h),o=n.filter(l=>Math.max(l[s],s==="error"?i:0)<=e);return o.length?{run:a(o,r),fits:!0}:{run:a(n,s),fits:!1}}function Yx(n,t,{goal:e,matters:i},s){if(n.fits!==t.fits)return n.fits?-1:1;if(i==="stability"){let a=Ld(n.run,s)-Ld(t.run,s);if(a)return a}let r=e==="error"===n.fits?"ms":"error";return n.run[r]-t.run[r]}function Ld(n,t){let[e,i]=t.stability[""]?.[n.model]??[1,1];return e/i}var Dd={shape:"its shape",stability:"that it never fails",cost:"its cost"},Ud={error:"at most this error (%)",budget:"at most this time (ms per frame)"},Zx=5;function Fd(){let n=document.getElementById("chooser"),t=Xt().chooser;if(!n||!t?.runs.length)return;let e={scene:0,family:"equilateral",cells:24,matters:"shape",goal:"error",most:1},i=C("div",{role:"status",id:"chosen-said"}),s=C("div",{}),r=a=>{let[o,...l]=a?[C("p",{class:"note open"},a)]:Kx(Nd(t,e),e,t);i.replaceChildren(o),s.replaceChildren(...l)};n.append(Jx(e,t,r),C("div",{class:"chosen"},i,s)),r()}function Jx(n,t,e){let i=(o,l)=>c=>{n[o]=l[c],e()},s=(o,l,c,h)=>Dn(o,c,h.indexOf(n[l]),i(l,h)),r=(o,l,c)=>{let h=C("input",{type:"number",min:l,step:"any",value:n[o],oninput:()=>{let f=Number(h.value),u=h.value!==""&&f>=l&&Number.isFinite(f);h.setAttribute("aria-invalid",!u),h.setAttribute("aria-describedby",u?"":"chosen-said"),n[o]=f,e(u?"":`${c}: give a number of at least ${l}.`)}});return C("label",{class:"choice"},C("span",{},c),h)},a=Object.keys(t.families);return C("form",{class:"asked",onsubmit:o=>o.preventDefault()},s("My cloth","scene",t.scenes,[...t.scenes.keys()]),s("Its mesh is","family",Object.values(t.families),a),r("cells",1,"Cells along its width"),s("What matters is","matters",Object.values(Dd),Object.keys(Dd)),s("I want","goal",Object.values(Ud),Object.keys(Ud)),r("most",1e-6,"Error or time"))}function Kx(n,t,e){let{best:i,fits:s,others:r,notes:a}=n;if(!i)return[C("p",{},...a)];let o=Xt().byId.get(i.id),l=Ga(o),c=s?[]:[C("b",{},jx(t))," The nearest: "];return[C("p",{class:"answer"},...c,...Qx(i)),t_(i,t,e),...a.map(h=>C("p",{class:"note open"},h)),C("h3",{},"Its config"),C("p",{class:"small grey"},"This config is the whole scene of the run. Copy bending and solver from the config, or save the config as FILE and call ",C("code",{},"./bendlab run FILE"),"."),C("p",{},Ge("Copy config",h=>Fi(l,h.currentTarget))),C("details",{},C("summary",{},"Show it"),C("pre",{},l)),r.length?e_(r):""]}var jx=n=>n.goal==="error"?`No measured run comes within ${Vt(n.most)} %.`:`No measured run takes at most ${Vt(n.most)} ms.`;function Qx(n){return[C("b",{},n.model),` by ${n.method} on ${n.cells} cells, ${n.substeps} \xD7 ${n.iterations} substeps \xD7 iterations, ${n.precision}: `,C("b",{},`${Vt(n.error)} %`),` off ${n.against} in `,C("b",{},`${Vt(n.ms)} ms`)," per frame."]}function t_(n,t,e){let[i,s]=e.stability[""]?.[n.model]??[0,0],r=e.stability[t.family]?.[n.model],a=e.stiffness[t.family]?.[n.model],o=(c,h,f)=>C("li",{},c," ",C("a",{href:h},f)),l=(c,h)=>`${c} of ${h}`;return C("ul",{},o("The run itself:",`accuracy/index.html#run-${encodeURIComponent(n.id)}`,"error, config and command"),s>0&&o(`Fails in ${l(i,s)} hard cases:`,"stability/index.html","stability"),r&&o(`On such meshes it fails in ${l(...r)} cases:`,"stability/index.html#meshes-and-units","cases"),a?o(`Its stated stiffness changes by ${Vt(100*(a-1),2)} % with the resolution on such meshes:`,"stiffness/index.html#calibrated","stiffness"):C("li",{class:"grey"},"Stiffness against resolution was not measured on such meshes."))}function e_(n){let t=["model","method","cells","substeps \xD7 iterations","error (%)","ms per frame","red hard cases"];return C("div",{},C("h3",{},"The other models and methods, each with its best run"),C("div",{class:"scroll"},C("table",{},C("thead",{},C("tr",{},...t.map((e,i)=>C("th",{class:i?null:"t"},e)))),C("tbody",{},...n.slice(0,Zx).map(n_)))))}function n_(n){let t=C("a",{href:`accuracy/index.html#run-${encodeURIComponent(n.id)}`},n.model),[e,i]=Xt().chooser.stability[""]?.[n.model]??[0,0],s=[n.method,n.cells,`${n.substeps} \xD7 ${n.iterations}`,Vt(n.error),Vt(n.ms),i?`${e} of ${i}`:"not measured"];return C("tr",{},C("td",{class:"t"},t),...s.map(r=>C("td",{},String(r))))}function Od(){let n=new Map([...document.querySelectorAll(".bar nav a")].map(s=>[s.hash.slice(1),s])),t=[...n.keys()].map(s=>document.getElementById(s)).filter(Boolean);if(!t.length)return;let e=()=>{let s=innerHeight*.35,a=innerHeight+scrollY>=document.documentElement.scrollHeight-4?t.at(-1):t.findLast(o=>o.getBoundingClientRect().top<=s);for(let[o,l]of n)o===a?.id?l.setAttribute("aria-current","true"):l.removeAttribute("aria-current")},i=!1;addEventListener("scroll",()=>{i||(i=!0,requestAnimationFrame(()=>{i=!1,e()}))},{passive:!0}),e()}function Bd(n){let t=[...n.tBodies[0].rows],e=new Map(t.map(h=>[h,h.textContent.toLowerCase()])),i=new Map(t.map(h=>[h,(h.querySelector("[data-run]")?.dataset.run??"").split(" ").filter(Boolean)])),s=[...n.tHead.rows[0].cells].flatMap((h,f)=>h.classList.contains("choose")?[i_(h,f,t,l)]:[]),r=C("input",{type:"search",placeholder:"Filter, such as adaptive 64",oninput:l,"aria-label":"Show the rows with these words"}),a=C("output",{}),o=n.dataset.rows??"rows";function l(){let h=r.value.toLowerCase().split(/\s+/).filter(Boolean),f=0;for(let u of t){let d=e.get(u),m=h.every(_=>d.includes(_))&&s.every(_=>_.fits(u))&&fi(i.get(u));u.hidden=!m,f+=m}a.textContent=f===t.length?`${f} ${o}`:`${f} of ${t.length} ${o}`}return(n.closest(".scroll")??n).before(C("div",{class:"filters",role:"search"},r,...s.map(h=>h.element),a)),bs(l),l(),{words:r,apply:l}}function i_(n,t,e,i){let s=o=>o.cells[t]?.textContent.trim()??"",r=[...new Set(e.map(s))],a=C("select",{onchange:i,"aria-label":n.textContent.trim()},C("option",{value:""},`${n.textContent.trim()}: all`),...r.map(o=>C("option",{value:`=${o}`},o||"\u2013")));return{element:a,fits:o=>!a.value||a.value===`=${s(o)}`}}var s_={diverged:"diverged",amber:"open",green:"yes"},He=null,gn=[],Vd=null,di=null,Gi=null;function Gd(){document.addEventListener("bendlab:open",n=>qc(n.detail.ids,n.detail.from)),document.addEventListener("click",n=>{let t=n.target.closest?.("[data-run]");if(!t||t.closest("dialog")||n.target.closest("a, summary"))return;let e=r_(t);qc(e.list,t.querySelector("button")??t,e.at)}),addEventListener("hashchange",kd),kd()}function kd(){try{let n=decodeURIComponent(location.hash.match(/^#run-(.+)$/)?.[1]??"");Xt().byId.has(n)&&qc([n],null)}catch(n){if(!(n instanceof URIError))throw n}}function r_(n){let e=[...(n.closest("table.shares")?null:n.closest("tbody"))?.querySelectorAll("[data-run]")??[n]].filter(s=>s.getClientRects().length).flatMap(s=>s.dataset.run.split(" ")),i=[...new Set(e)];return{list:i,at:i.indexOf(n.dataset.run.split(" ")[0])}}function qc(n,t,e=0){gn=n.filter(i=>Xt().byId.has(i)),gn.length&&(Vd=t,He||(He=C("dialog",{class:"run","aria-labelledby":"run-title"}),He.addEventListener("close",a_),He.addEventListener("click",i=>{i.target===He&&He.close()}),document.body.append(He)),Wd(Math.max(0,e)),He.open||He.showModal())}function a_(){Hd(),history.replaceState(null,"",location.pathname+location.search),Vd?.focus?.()}function Hd(){document.dispatchEvent(new CustomEvent("bendlab:discard",{detail:{element:di}})),di=null}function Wd(n){let t=Xt().byId.get(gn[n]);Hd();let e=(s,r,a)=>Ge(r,()=>{Wd(n+s),(He.querySelector(`[aria-label="${a}"]:not(:disabled)`)??He.querySelector("[autofocus]")).focus()},{"aria-label":a,disabled:n+s<0||n+s>=gn.length}),i=C("header",{},C("h2",{id:"run-title"},t.title??t.label),gn.length>1&&C("span",{class:"grey small"},`${n+1} of ${gn.length}`),gn.length>1&&e(-1,"\u2039","The run before"),gn.length>1&&e(1,"\u203A","The next run"),Ge("Close",()=>He.close(),{autofocus:!0}));He.replaceChildren(i,C("div",{class:"body"},...l_(t))),He.scrollTop=0,history.replaceState(null,"",`#run-${encodeURIComponent(t.id)}`),di&&o_(t)}function o_(n){document.dispatchEvent(new CustomEvent("bendlab:player",{detail:{element:di}})),n.frames.count<=2&&di.player&&Object.assign(di.player,{time:1/0,played:!0})}function l_(n){let t=[C("p",{},C("span",{class:`status ${n.status}`},n.status),n.outcome&&C("span",{class:"grey"},` \xB7 ${n.outcome}`))],e=typeof n.why=="number"?Xt().texts[n.why]:n.why;t.push(h_(n)),e&&t.push(C("div",{class:`note ${s_[n.status]??"no"}`},C("p",{},e))),n.frames?(di=C("div",{class:"player","data-runs":n.id}),t.push(di)):n.view&&t.push(C("h3",{},"Watch it"),zd(n.view));for(let s of n.warnings??[])t.push(C("div",{class:"note open"},C("p",{},C("b",{},s.code),`: ${s.message}`)));n.stills&&t.push(c_(n.stills)),n.command&&t.push(C("h3",{},"Repeat it"),zd(n.command));let i=C("div",{},...Xd(n),...qd(n));return t.push(...u_(n,i),i),t}function c_(n){let t=C("a",{href:n,onclick:()=>He.close()},"Stills of this group of cases");return C("p",{class:"small"},t)}function zd(n){let t=e=>Fi(n,e.currentTarget);return C("div",{class:"copy"},C("code",{},n),Ge("Copy",t))}function h_(n){let t=n.worst;if(!t)return C("p",{class:"worst grey"},"No bound is stated for this run.");let e=t.limit===void 0||t.limit===null?"":` \u2014 limit ${pn(Ke(t.limit),t.unit)}${t.held?", held":", broken"}`;return C("p",{class:"worst"},`${t.label} `,C("b",{},t.text??pn(Ke(t.value),t.unit)),C("span",{class:"grey"},e,t.note?` (${t.note})`:""))}function u_(n,t){let e=Xt().runs.filter(r=>r!==n&&(r.summary||r.changes));if(!e.length)return[];let i=["its neighbours in the list",...e.map(r=>r.title??r.label)],s=r=>{Gi=e[r-1]??null,t.replaceChildren(...Xd(n),...qd(n))};return[C("p",{class:"tools"},Dn("Compare with",i,1+e.indexOf(Gi),s))]}function Xd(n){let t=Xt().summary??{},e=Object.entries(n.summary??{}).filter(([r])=>r in t);if(!e.length)return[];let i=Gi===n?null:Gi,s=["","this run",i?.title??i?.label,"ratio"];return[C("h3",{},"Numbers"),C("div",{class:"scroll"},C("table",{},i&&C("thead",{},C("tr",{},...s.map(r=>C("th",{},r)),C("th",{}))),C("tbody",{},...e.map(([r,a])=>C("tr",{},C("th",{class:"t",scope:"row"},t[r].label),C("td",{},pn(Ke(a),t[r].unit,4)),i&&C("td",{},pn(Ke(i.summary?.[r]),t[r].unit,4)),i&&C("td",{},Vt(Ke(a)/Ke(i.summary?.[r]))),C("td",{class:"t text grey"},t[r].meaning??""))))))]}function qd(n){if(!n.changes&&n.base===void 0)return[];let t=gn.indexOf(n.id),e=Gi&&Gi!==n?[Gi]:gn.length>1?[gn[t-1],gn[t+1]].filter(Boolean).map(a=>Xt().byId.get(a)):Xt().runs.filter(a=>a!==n&&a.base===n.base).slice(0,2),i=Rd([n,...e]),s=i.length?C("div",{class:"scroll"},C("table",{},C("thead",{},C("tr",{},C("th",{class:"t"},"setting"),C("th",{class:"t"},"this run"),...e.map(a=>C("th",{class:"t"},a.title??a.label)))),C("tbody",{},...i.map(({pointer:a,values:o})=>C("tr",{},C("td",{class:"t"},C("code",{},a)),...o.map((l,c)=>C("td",{class:c===0?"t here":"t"},l))))))):C("p",{class:"grey"},"No setting differs."),r=Ga(n);return[C("h3",{},"Config, where it differs"),s,C("details",{},C("summary",{},"The whole config"),C("p",{},Ge("Copy",a=>Fi(r,a.currentTarget))),C("pre",{},r))]}function $d(n){let t=[...n.tHead.rows[n.tHead.rows.length-1].cells];t.forEach((e,i)=>{if(e.classList.contains("fixed"))return;let s=document.createElement("button");s.type="button",s.className="sort",s.append(...e.childNodes),e.append(s),s.addEventListener("click",()=>{let r=e.getAttribute("aria-sort")==="ascending";for(let a of t)a.removeAttribute("aria-sort");e.setAttribute("aria-sort",r?"descending":"ascending"),f_(n,i,r?-1:1)})})}function f_(n,t,e){let i=n.tBodies[0],s=[...i.rows].map((r,a)=>({row:r,i:a,key:d_(r.cells[t])}));s.sort((r,a)=>m_(r.key,a.key,e)||r.i-a.i),i.append(...s.map(({row:r})=>r))}function d_(n){let t=n?.dataset.v;if(t!==void 0){let i=Number(t.replace("\u221E","Infinity"));return t===""?null:Number.isNaN(i)?t:i}let e=n?.textContent.trim();return e?p_(e)??e:null}function p_(n){let t=/^(?:± ?)?([-−]?\d[\d,\u202f]*(?:\.\d+)?)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)|e([-+]?\d+))?(?![\w²])/.exec(n);if(/^[-−]?∞$/.test(n))return n==="\u221E"?1/0:-1/0;if(!t)return null;let e=Number(t[1].replace("\u2212","-").replace(/[,\u202f]/g,"")),i=t[3]??t[2]?.replace(/./g,s=>s==="\u207B"?"-":"\u2070\xB9\xB2\xB3\u2074\u2075\u2076\u2077\u2078\u2079".indexOf(s))??0;return e*10**Number(i)}function m_(n,t,e){if(n===null||t===null)return n===t?0:n===null?1:-1;if(typeof n!=typeof t)return typeof n=="number"?-1:1;let i=typeof n=="number"?Math.sign(n-t)||0:n.localeCompare(t,"en",{numeric:!0,sensitivity:"base"});return e*i}var g_=3;function Zd(){for(let n of document.querySelectorAll("table.sortable"))Yd(n),n.tBodies[0].rows.length>g_&&Bd(n),$d(n);for(let n of document.querySelectorAll("table.cards"))n.tHead&&Yd(n);Gd()}function Yd(n){let t=[...n.tHead.rows[n.tHead.rows.length-1].cells].map(s=>(s.dataset.label??s.textContent).trim()),e=matchMedia("(max-width: 560px)"),i=()=>{if(e.matches){e.removeEventListener("change",i);for(let s of n.tBodies[0].rows)[...s.cells].forEach((r,a)=>{r.dataset.label=t[a]})}};e.addEventListener("change",i),i()}function Jd(){Od(),Zd(),Td(),Fd()}function Kd(n){document.readyState==="loading"?document.addEventListener("DOMContentLoaded",n):n()}var x_=10;function Qd(){let{explorer:n,runs:t,summary:e}=Xt(),i=n.axes.map((r,a)=>{let o=h=>n.places[h.id]?.[a]??null,l=h=>{let f=o(h);return f===null?NaN:r.numbers?r.numbers[f]:f},c=r.numbers?jd(r.numbers):"band";return{...r,of:l,scale:c,text:h=>r.texts[o(h)]??null}}),s=n.numbers.map(r=>{let a=o=>Ke(o.summary?.[r]);return{name:r,...e[r],texts:null,looks:null,of:a,scale:jd(t.map(a))}});return{axes:i,numbers:s}}function jd(n){let t=n.filter(Number.isFinite),e=Math.min(...t);return t.length&&e>0&&Math.max(...t)>=x_*e?"log":"linear"}function tp(n,t,e,i,s,r){let a=n.texts.map((l,c)=>{let h=e.filter(d=>n.text(d)===l);if(!h.length)return null;let f=h.filter(i),u=C("button",{type:"button",class:"opens",title:"Choose these runs","aria-pressed":s(h),onclick:()=>r(h)},os(n.looks[c],"mark"),` ${l}`);return C("tr",{},C("td",{class:"t"},u),C("td",{},String(f.length)),...t.map(d=>C("td",{},Vt(__(f.map(d.of))))))}),o=["runs",...t.map(l=>`median ${ci(l.label,l.unit)}`)];return C("div",{class:"scroll"},C("table",{},C("thead",{},C("tr",{},C("th",{class:"t"},n.label),...o.map(l=>C("th",{},l)))),C("tbody",{},...a.filter(Boolean))))}function __(n){let t=n.filter(r=>!Number.isNaN(r)).sort((r,a)=>r-a);if(!t.length)return NaN;let e=(t.length-1)/2,[i,s]=[t[Math.floor(e)],t[Math.ceil(e)]];return i===s?i:(i+s)/2}var ep=104,pi=46,gr=18,Hi=330,y_=64,np=110,v_=4,b_={ArrowUp:[-1,0],ArrowDown:[1,0],ArrowRight:[0,-1],ArrowLeft:[0,1],Delete:[-1/0,1/0]},Ha=class{constructor(t,e){this.open=t,this.changed=e,this.ranges=new Map,this.element=C("div",{class:"scroll parallel"}),new ResizeObserver(()=>this.#t()).observe(this.element)}show(t,e,i){Object.assign(this,{dimensions:t,runs:e,lookOf:i});let s=[...this.ranges.keys()].filter(r=>!t.some(a=>a.name===r));for(let r of s)this.ranges.delete(r);this.#t(),s.length&&this.changed()}get inside(){if(!this.ranges.size)return null;let t=e=>this.lines.every(({dimension:i,scale:s})=>{let r=this.ranges.get(i.name),a=s(i.of(e));return!r||a>=r[0]&&a<=r[1]});return this.runs.filter(t).map(e=>e.id)}clear(){this.ranges.clear(),this.#t()}mark(t){this.isChosen=t;for(let{run:e,path:i}of this.curves??[])i.classList.toggle("off",!t(e.id))}#t(){let{dimensions:t}=this;if(!t?.length||!this.element.clientWidth)return;let e=np+y_,i=e+ep*(t.length-1),s=Math.max(this.element.clientWidth-2,i),r=t.length>1?(s-e)/(t.length-1):0;this.lines=t.map((o,l)=>({dimension:o,x:np+l*r,...M_(o,this.runs)}));let a=Tt("svg",{class:"picture",width:s,height:Hi,viewBox:`0 0 ${s} ${Hi}`,role:"group","aria-label":"A line for each setting and number, a curve for each run. On a line, up and down move the upper end of the chosen part, right and left its lower end, Delete chooses all."});this.curves=this.runs.map(o=>({run:o,path:this.#n(o)})).filter(({path:o})=>o),a.append(Tt("g",{"aria-hidden":"true"},...this.curves.map(({path:o})=>o))),a.append(...this.lines.map(o=>this.#e(o,r))),this.element.replaceChildren(a),this.isChosen&&this.mark(this.isChosen)}#n(t){let e=this.lines.map(({x:r,scale:a,dimension:o})=>[r,a(o.of(t))]),i=da().defined(([,r])=>Number.isFinite(r))(e);if(!i)return null;let s=Tt("path",{class:"line run-line",d:i},Tt("title",{},t.title??t.label));return s.addEventListener("click",()=>this.open(t.id)),bn(s,this.lookOf(t))}#e(t,e){let{dimension:i,x:s,ticks:r,text:a}=t,o=ci(i.label,i.unit),l=or(o,Math.max(e,ep)/6.6).slice(0,2),c=Tt("g",{class:"axis","aria-hidden":"true"},Tt("path",{class:"base",d:`M${s} ${pi}V${Hi-gr}`}),...rs(l,{class:"title",x:s,y:pi-18,"text-anchor":"middle"}),...r.map(({y:h,value:f})=>Tt("text",{x:s-6,y:h+4,"text-anchor":"end"},a(f))));return t.handle=Tt("rect",{class:"handle",x:s-14,y:pi-8,width:28,height:Hi-pi-gr+16,tabindex:0,role:"slider","aria-label":o,"aria-orientation":"vertical"}),t.brush=Tt("rect",{class:"brush",x:s-8,width:16}),this.#s(t),this.#l(t),Tt("g",{},c,t.brush,t.handle)}#i({dimension:t,scale:e}){let i=[...new Set(this.runs.map(a=>e(t.of(a))))].filter(Number.isFinite);i.sort((a,o)=>a-o);let[s,r]=this.ranges.get(t.name)??[-1/0,1/0];return{all:i,upper:i.findIndex(a=>a>=s),lower:i.findLastIndex(a=>a<=r)}}#s(t){let{dimension:e,scale:i,handle:s,brush:r}=t,a=this.ranges.get(e.name);ip(r,a??[0,0]);let o=d=>!a||i(d)>=a[0]&&i(d)<=a[1],l=this.runs.map(e.of).filter(d=>!Number.isNaN(d)&&o(d)),c=d=>e.scale==="band"?e.texts[d]:Vt(d),h=l.length?`${c(Math.min(...l))} to ${c(Math.max(...l))}`:"no run",{all:f,upper:u}=this.#i(t);s.setAttribute("aria-valuetext",a?h:`all, ${h}`),s.setAttribute("aria-valuemax",f.length-1),s.setAttribute("aria-valuenow",f.length-1-u)}#a(t,e){e?this.ranges.set(t.dimension.name,e):this.ranges.delete(t.dimension.name),this.#s(t),this.changed()}#r(t,e){let{all:i,upper:s,lower:r}=this.#i(t),a=b_[e.key];if(!a||!i.length)return;e.preventDefault();let o=i.length-1,l=s<0||s>r,[c,h]=l?[0,o]:[s,r],f=Math.min(Math.max(c+a[0],0),h),u=Math.min(Math.max(h+a[1],c),o);this.#a(t,f===0&&u===o?null:[i[f],i[u]])}#l(t){let{handle:e,brush:i}=t,s=null,r=a=>{let o=e.ownerSVGElement.getBoundingClientRect();return Math.min(Math.max(a.clientY-o.top,pi-8),Hi-gr+8)};e.addEventListener("keydown",a=>this.#r(t,a)),e.addEventListener("pointerdown",a=>{a.button===0&&(e.setPointerCapture(a.pointerId),s=r(a))}),e.addEventListener("pointermove",a=>{s!==null&&ip(i,[Math.min(s,r(a)),Math.max(s,r(a))])}),e.addEventListener("pointercancel",()=>{s=null,this.#s(t)}),e.addEventListener("pointerup",a=>{if(s===null)return;let o=[Math.min(s,r(a)),Math.max(s,r(a))];s=null,this.#a(t,o[1]-o[0]<v_?null:o)})}};function ip(n,[t,e]){n.setAttribute("y",t-2),n.setAttribute("height",e?e-t+4:0)}function M_(n,t){let e=[Hi-gr,pi];if(n.scale==="band"){let{scale:o}=Jn("band",n.texts.map((l,c)=>c),e.toReversed());return{scale:l=>o(l)??NaN,ticks:n.texts.map((l,c)=>({value:c,y:o(c)})),text:l=>S_(n.texts[l],16)}}let i=n.scale==="log",s=vs(t.map(n.of),i,.02,!1),r=Jn(n.scale,s,e,n.numbers,40);return{scale:o=>{if(Number.isNaN(o))return NaN;let l=o===1/0?pi-6:i&&o<=0?1/0:r.scale(o);return Math.min(Math.max(l,pi-6),Hi-gr+6)},ticks:r.ticks.map(o=>({value:o,y:r.scale(o)})),text:r.text}}var S_=(n,t)=>n.length>t?`${n.slice(0,t-1)}\u2026`:n;var w_=8;function sp(){let n=document.getElementById("explorer");n&&Xt().explorer&&new $c(n)}var $c=class{constructor(t){Object.assign(this,Qd()),this.all=[...this.axes,...this.numbers],this.runs=Xt().runs.filter(r=>r.summary);let e=this.axes.slice(0,5),i=this.numbers.find(r=>r.name==="ms_per_frame"),s=this.numbers.filter(r=>r!==i).slice(0,w_-1-e.length);this.shown=[...e,...s,...i?[i]:[]],this.colouring=this.axes.find(r=>r.looks)??null,this.parallel=new Ha(r=>Ui([r]),()=>za(this.parallel.inside)),this.count=C("output",{}),this.clear=Ge("All runs",()=>{this.parallel.clear(),za(null)}),this.groups=C("div",{}),this.figure=C("figure",{class:"chart drawn"}),this.x=i??this.all[0],this.y=this.numbers.find(r=>r!==this.x)??this.all.at(-1),t.replaceChildren(this.#t(),this.parallel.element,this.groups,C("h3",{},"Any number against any other"),this.#n(),this.figure),bs(()=>this.#s()),this.#i()}#t(){let t=["one colour",...this.axes.map(a=>a.label)],e=Dn("Colour and group by",t,1+this.axes.indexOf(this.colouring),a=>{this.colouring=this.axes[a-1]??null,this.#i()}),i=this.all.map(a=>C("label",{},C("input",{type:"checkbox",checked:this.shown.includes(a),onchange:o=>{let l=c=>c===a?o.target.checked:this.shown.includes(c);this.shown=this.all.filter(l),this.#i()}}),` ${a.label}`)),s=C("summary",{},"Lines to show"),r=C("details",{},s,C("div",{class:"choices"},...i));return C("div",{class:"tools"},e,r,this.clear,this.count)}#n(){let t=(i,s,r)=>Dn(i,s.map(a=>a.label),s.indexOf(this[r]),a=>{this[r]=s[a],this.#a()}),e=this.all.filter(i=>i.scale!=="band");return C("div",{class:"tools"},t("Number",e,"y"),t("Against",this.all,"x"))}#e(t){let e=this.colouring;return e?.looks?.[e.texts.indexOf(e.text(t))]??Xt().explorer.plain}#i(){this.parallel.show(this.shown,this.runs,t=>this.#e(t)),this.#a(),this.#s()}#s(){let t=this.runs.filter(f=>fi([f.id])),e=Wc()===null;this.count.textContent=e?`${this.runs.length} runs`:`${t.length} of ${this.runs.length} runs`,this.clear.disabled=e,this.parallel.mark(f=>fi([f]));let i=this.shown.filter(f=>!f.texts),{inside:s}=this.parallel,r=f=>s?.includes(f.id)??!0,a=new Set(s?[]:Wc()),o=f=>f.every(({id:u})=>a.has(u)),l=f=>{let u=o(f);for(let{id:d}of f)u?a.delete(d):a.add(d);this.parallel.clear(),za(a.size?a:null)},c=()=>[...this.groups.querySelectorAll("button")],h=c().indexOf(document.activeElement);this.groups.replaceChildren(...this.colouring?[tp(this.colouring,i,this.runs,r,o,l)]:[]),c()[h]?.focus()}#a(){this.figure.chart?.dispose(),this.figure.replaceChildren(),this.figure.chart=new Ms(this.figure,this.#r())}#r(){let{x:t,y:e,colouring:i}=this,s=new Map;for(let l of this.runs){if(Number.isNaN(t.of(l))||Number.isNaN(e.of(l)))continue;let c=i?.text(l)??"runs";s.has(c)||s.set(c,[]),s.get(c).push(l)}let r=[...s].map(([l,c])=>{let h=c.sort((f,u)=>t.of(f)-t.of(u));return{label:l,look:this.#e(h[0]),x:h.map(t.of),y:{[e.name]:h.map(f=>A_(e.of(f)))},runs:h.map(f=>[f.id])}}),a=`${e.label} against ${t.label}`,o=t.scale==="band"?{scale:"band",categories:t.texts}:{scale:t.scale};return{id:"explored",kind:"lines",title:a,x:{...t,...o},ys:[e],choice:0,series:r,held:[],limits:[],joined:!1,dodge:!1,y_scale:e.scale==="log"?"log":"linear"}}},A_=n=>Number.isFinite(n)?n:n>0?"\u221E":"-\u221E";function rp(n){if(Uint8Array.fromBase64)return Uint8Array.fromBase64(n);let t=atob(n),e=new Uint8Array(t.length);for(let i=0;i<t.length;++i)e[i]=t.charCodeAt(i);return e}async function ap(n){let t=new Blob([n]).stream().pipeThrough(new DecompressionStream("deflate"));return new Uint8Array(await new Response(t).arrayBuffer())}var Wa=class{constructor(t,e){this.head=t,this.text=e,this.bytes=rp(e.slice(0,4*Math.ceil(t.sections.frames.offset/3))),this.vertices=t.vertices,this.count=t.count,this.times=Float64Array.from(t.times),this.decoded=0,this.lattice=null}async open(){let{sections:t}=this.head;return[this.rest,this.triangles,this.pinned,this.seeds]=await Promise.all(["rest","triangles","pinned","seeds"].map(e=>this.array(e))),this.obstacles=await Promise.all(this.head.obstacles.map(async({section:e,velocity:i})=>({velocity:i,points:await this.array(`${e}-points`),triangles:await this.array(`${e}-triangles`)}))),this.lattice=new Uint16Array(3*this.vertices*this.count),this.lattice.set(await this.array("first")),this.decoded=1,this}#t;#n(t){return this.bytes.subarray(t.offset,t.offset+t.size)}async#e(){let{frames:t}=this.head.sections;if(this.#t||this.count<2)return;let e=Math.floor(t.offset/3),i=rp(this.text.slice(4*e));this.text=null;let[s,r,a]=await Promise.all([this.array("parents"),this.array("groups"),ap(i.subarray(t.offset-3*e,t.offset-3*e+t.size))]);this.#t=C_(a,t,s,r,this.lattice,this.vertices)}#i(){this.#t(),++this.decoded===this.count&&(this.#t=null)}async decodeAll(t=()=>!0){if(this.decoded!==this.count)for(this.preparing??=this.#e(),await this.preparing;this.decoded<this.count&&t();){let e=performance.now()+12;for(;this.decoded<this.count&&performance.now()<e;)this.#i();await new Promise(i=>setTimeout(i))}}async array(t){let e=this.head.sections[t];if(!e)return null;let i=await ap(this.#n(e)),s=T_(i,e.rows,e.columns);return e.kind==="floats"?new Float32Array(s.buffer):E_(s,e.rows,e.columns)}positions(t,e=new Float32Array(3*this.vertices)){let{origin:[i,s,r],step:a}=this.head,o=t*this.vertices*3;for(let l=0;l<e.length;l+=3)e[l]=i+a*this.lattice[o+l],e[l+1]=s+a*this.lattice[o+l+1],e[l+2]=r+a*this.lattice[o+l+2];return e}frameAt(t){let e=0,i=this.decoded-1;for(;e<i;){let s=e+i+1>>1;this.times[s]<=t+1e-9?e=s:i=s-1}return e}};function T_(n,t,e){let i=new Uint32Array(t*e),s=new Uint8Array(i.buffer);for(let r=0,a=0;r<e;++r)for(let o=0;o<4;++o)for(let l=0;l<t;++l,++a)s[4*(l*e+r)+o]=n[a];return i}function E_(n,t,e){for(let i=0;i<e;++i)for(let s=0,r=i,a=0;s<t;++s,r+=e){let o=n[r];a+=o>>>1^-(o&1),n[r]=a}return n}function C_(n,{weights:t,counts:e},i,s,r,a){let o=3*a,l=r.length-o,c=new Uint32Array(16);e.reduce((M,A,b)=>(c[b]=M,M+A),0);let h=new Uint32Array(i.length);for(let M=0,A=0;M<a;++M)for(let b=0;b<6;++b,++A)h[A]=3*(M-i[A]);let f=new Int32Array(o),u=new Int32Array(o),d=new Int32Array(o),m=new Int32Array(o),_=1,p=2**12;function g(M){let A=Math.min(31-Math.clz32(M+1),15),b=c[A]++,E=n[b]|n[l+b]<<8;return E>>>1^-(E&1)}return()=>{let M=_*o;f.fill(0,0,3);for(let A=0,b=0,E=0;A<a;++A,E+=6){let S=h[E],x=h[E+1],w=h[E+2],O=h[E+3],P=h[E+4],D=h[E+5],N=t[s[A]];for(let V=0;V<3;++V,++b){let I=A===0?m[b]:d[S+V]+d[x+V]+2*m[b];V>0&&(I+=d[b-1]);let W=g(I);d[b]=Math.abs(W);let Y=N[0]*u[b]+N[1]*f[S+V]+N[2]*f[x+V]+N[3]*f[w+V]+N[4]*f[O+V]+N[5]*f[P+V]+N[6]*f[D+V]+N[7]*u[S+V]+N[8]*u[x+V]+N[9]*u[w+V]+N[10]*u[O+V]+N[11]*u[P+V]+N[12]*u[D+V],G=r[M-o+b],tt=G+Math.floor((Y+p/2)/p)+W&65535;f[b]=tt-G,r[M+b]=tt}}++_,[f,u]=[u,f],[d,m]=[m,d]}}var Xa=new Map;function qa(n){return(Xt().runs??[]).find(t=>t.id===n)??{id:n,label:n,frames:null,remedy:"This page has no such run."}}function op(n){Xa.delete(n)}function lp(n){if(!Xa.has(n.id)){let t=document.getElementById(n.frames.dom);Xa.set(n.id,t?new Wa(n.frames,t.textContent.trim()).open():Promise.reject(new Error("Its frames are not in this page.")))}return Xa.get(n.id)}var cp={complete:"The run is complete.",implausible:"The run ended as implausible.",diverged:"The run diverged.",interrupted:"The run was stopped."};function hp(){let{live:n}=Xt(),t=document.getElementById("live");if(!n||!t)return;for(let r of document.querySelectorAll(".player"))r.player&&Object.assign(r.player,{time:1/0,played:!0});let e=`${n.frames}-running`,i=0;async function s(){try{let r=await fetch(`frames?have=${e}`,{cache:"no-store"});if(r.status===200){let a=await r.json();if(e=`${a.frames}-${a.status}`,await R_(a,t),cp[a.status])return}i=0}catch{++i>=3&&(t.textContent="The server does not answer: bendlab view --live has ended. The frames here stay.")}setTimeout(s,1e3*n.every*Math.min(2**i,16))}setTimeout(s,1e3*n.every)}async function R_(n,t){t.textContent=`${n.frames} frames, t = ${Vt(n.time)} s of ${Vt(n.duration)} s. `+(cp[n.status]??"The run goes on.");let e=Xt().byId.get(n.run.id);if(!e||!n.run.frames)return;Object.assign(e,n.run,{status:n.status}),document.getElementById(e.frames.dom).textContent=n.scripts,op(e.id);for(let s of document.querySelectorAll(".player"))await I_(s.player);let i=document.querySelector("figure.chart[data-chart='over-time']");n.chart&&i?.chart&&i.chart.replace(n.chart)}async function I_(n){if(!n||n.disposed||!n.views.length)return;let t=n.time>=n.last-1e-9||n.playing,e=n.views.map(i=>i.orbit);await n.start(),n.views.forEach((i,s)=>{e[s]?.moved&&i.orbit.copy(e[s])}),t&&n.seek(n.last)}var Bp=0,bh=1,kp=2;var Gr=1,zp=2,$s=3,Ri=0,qe=1,Pe=2,ji=0,Ys=1,Mh=2,Sh=3,wh=4,Vp=5;var Qi=100,Gp=101,Hp=102,Wp=103,Xp=104,qp=200,$p=201,Yp=202,Zp=203,Ah=204,Th=205,Jp=206,Kp=207,jp=208,Qp=209,tm=210,em=211,nm=212,im=213,sm=214,yo=0,vo=1,bo=2,ks=3,Mo=4,So=5,wo=6,Ao=7,Eh=0,rm=1,am=2,Hn=0,Ch=1,Rh=2,Ih=3,Ph=4,Lh=5,Nh=6,Dh=7;var Uh=300,ts=301,Zs=302,Jo=303,Ko=304,To=1e3,kn=1001,Eo=1002,ue=1003,om=1004;var Hr=1005;var fe=1006,jo=1007;var si=1008;var $e=1009,Fh=1010,Oh=1011,Js=1012,Qo=1013,Ye=1014,Rn=1015,In=1016,tl=1017,el=1018,es=1020,Bh=35902,kh=35899,zh=1021,Vh=1022,cn=1023,ii=1026,ri=1027,Gh=1028,nl=1029,Ii=1030,il=1031;var sl=1033,Wr=33776,Xr=33777,qr=33778,$r=33779,rl=35840,al=35841,ol=35842,ll=35843,cl=36196,hl=37492,ul=37496,fl=37488,dl=37489,Yr=37490,pl=37491,ml=37808,gl=37809,xl=37810,_l=37811,yl=37812,vl=37813,bl=37814,Ml=37815,Sl=37816,wl=37817,Al=37818,Tl=37819,El=37820,Cl=37821,Rl=36492,Il=36494,Pl=36495,Ll=36283,Nl=36284,Zr=36285,Dl=36286;var wr=2300,Co=2301,xo=2302,ph=2303,mh=2400,gh=2401,xh=2402;var lm=3200;var Hh=0,cm=1,ai="",nn="srgb",Zi="srgb-linear",Ar="linear",jt="srgb";var _o=7680;var hm=519,um=512,fm=513,dm=514,Jr=515,pm=516,mm=517,Wh=518,Xh=519,qh=35044,Kr=35048;var yn="300 es",_n=2e3,Tr=2001;function P_(n){for(let t=n.length-1;t>=0;--t)if(n[t]>=65535)return!0;return!1}function L_(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function Er(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function gm(){let n=Er("canvas");return n.style.display="block",n}var up={},zs=null;function Cr(...n){let t="THREE."+n.shift();zs?zs("log",t,...n):console.log(t,...n)}function xm(n){let t=n[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=n[1];e&&e.isStackTrace?n[0]+=" "+e.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function Rt(...n){n=xm(n);let t="THREE."+n.shift();if(zs)zs("warn",t,...n);else{let e=n[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...n)}}function Pt(...n){n=xm(n);let t="THREE."+n.shift();if(zs)zs("error",t,...n);else{let e=n[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...n)}}function br(...n){let t=n.join(" ");t in up||(up[t]=!0,Rt(...n))}function _m(n,t,e){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(t,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:i()}}setTimeout(r,e)})}var ym={[yo]:yo,[bo]:wo,[Mo]:Mo,[ks]:So,[vo]:vo,[wo]:bo,[Ao]:Ao,[So]:ks},zn=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[t]===void 0&&(i[t]=[]),i[t].indexOf(e)===-1&&i[t].push(e)}hasEventListener(t,e){let i=this._listeners;return i===void 0?!1:i[t]!==void 0&&i[t].indexOf(e)!==-1}removeEventListener(t,e){let i=this._listeners;if(i===void 0)return;let s=i[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let i=e[t.type];if(i!==void 0){t.target=this;let s=i.slice(0);for(let r=0,a=s.length;r<a;r++)s[r].call(this,t);t.target=null}}},Oe=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],fp=1234567,Mr=Math.PI/180,Vs=180/Math.PI;function Pi(){let n=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(Oe[n&255]+Oe[n>>8&255]+Oe[n>>16&255]+Oe[n>>24&255]+"-"+Oe[t&255]+Oe[t>>8&255]+"-"+Oe[t>>16&15|64]+Oe[t>>24&255]+"-"+Oe[e&63|128]+Oe[e>>8&255]+"-"+Oe[e>>16&255]+Oe[e>>24&255]+Oe[i&255]+Oe[i>>8&255]+Oe[i>>16&255]+Oe[i>>24&255]).toLowerCase()}function Ot(n,t,e){return Math.max(t,Math.min(e,n))}function $h(n,t){return(n%t+t)%t}function N_(n,t,e,i,s){return i+(n-t)*(s-i)/(e-t)}function D_(n,t,e){return n!==t?(e-n)/(t-n):0}function Sr(n,t,e){return(1-e)*n+e*t}function U_(n,t,e,i){return Sr(n,t,1-Math.exp(-e*i))}function F_(n,t=1){return t-Math.abs($h(n,t*2)-t)}function O_(n,t,e){return n<=t?0:n>=e?1:(n=(n-t)/(e-t),n*n*(3-2*n))}function B_(n,t,e){return n<=t?0:n>=e?1:(n=(n-t)/(e-t),n*n*n*(n*(n*6-15)+10))}function k_(n,t){return n+Math.floor(Math.random()*(t-n+1))}function z_(n,t){return n+Math.random()*(t-n)}function V_(n){return n*(.5-Math.random())}function G_(n){n!==void 0&&(fp=n);let t=fp+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function H_(n){return n*Mr}function W_(n){return n*Vs}function X_(n){return n>0&&Number.isInteger(n)&&2**Math.round(Math.log2(n))===n}function q_(n){return Math.pow(2,Math.ceil(Math.log(n)/Math.LN2))}function Yh(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function $_(n,t,e,i,s){let r=Math.cos,a=Math.sin,o=r(e/2),l=a(e/2),c=r((t+i)/2),h=a((t+i)/2),f=r((t-i)/2),u=a((t-i)/2),d=r((i-t)/2),m=a((i-t)/2);switch(s){case"XYX":n.set(o*h,l*f,l*u,o*c);break;case"YZY":n.set(l*u,o*h,l*f,o*c);break;case"ZXZ":n.set(l*f,l*u,o*h,o*c);break;case"XZX":n.set(o*h,l*m,l*d,o*c);break;case"YXY":n.set(l*d,o*h,l*m,o*c);break;case"ZYZ":n.set(l*m,l*d,o*h,o*c);break;default:Rt("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Ul(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Zh(n,t){if(t.constructor===Float32Array)return n;let e=Ul(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/e,-1)}function Jh(n,t){if(t.constructor===Float32Array)return n;let e=Ul(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*e)}var Kh={DEG2RAD:Mr,RAD2DEG:Vs,generateUUID:Pi,clamp:Ot,euclideanModulo:$h,mapLinear:N_,inverseLerp:D_,lerp:Sr,damp:U_,pingpong:F_,smoothstep:O_,smootherstep:B_,randInt:k_,randFloat:z_,randFloatSpread:V_,seededRandom:G_,degToRad:H_,radToDeg:W_,isPowerOfTwo:X_,ceilPowerOfTwo:q_,floorPowerOfTwo:Yh,setQuaternionFromProperEuler:$_,normalize:Jh,denormalize:Zh},$t=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,i=this.y,s=t.elements;return this.x=s[0]*e+s[3]*i+s[6],this.y=s[1]*e+s[4]*i+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Ot(this.x,t.x,e.x),this.y=Ot(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=Ot(this.x,t,e),this.y=Ot(this.y,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ot(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Ot(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y;return e*e+i*i}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let i=Math.cos(e),s=Math.sin(e),r=this.x-t.x,a=this.y-t.y;return this.x=r*i-a*s+t.x,this.y=r*s+a*i+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Vn=class{constructor(t=0,e=0,i=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=i,this._w=s}static slerpFlat(t,e,i,s,r,a,o){let l=i[s+0],c=i[s+1],h=i[s+2],f=i[s+3],u=r[a+0],d=r[a+1],m=r[a+2],_=r[a+3];if(f!==_||l!==u||c!==d||h!==m){let p=l*u+c*d+h*m+f*_;p<0&&(u=-u,d=-d,m=-m,_=-_,p=-p);let g=1-o;if(p<.9995){let M=Math.acos(p),A=Math.sin(M);g=Math.sin(g*M)/A,o=Math.sin(o*M)/A,l=l*g+u*o,c=c*g+d*o,h=h*g+m*o,f=f*g+_*o}else{l=l*g+u*o,c=c*g+d*o,h=h*g+m*o,f=f*g+_*o;let M=1/Math.sqrt(l*l+c*c+h*h+f*f);l*=M,c*=M,h*=M,f*=M}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=f}static multiplyQuaternionsFlat(t,e,i,s,r,a){let o=i[s],l=i[s+1],c=i[s+2],h=i[s+3],f=r[a],u=r[a+1],d=r[a+2],m=r[a+3];return t[e]=o*m+h*f+l*d-c*u,t[e+1]=l*m+h*u+c*f-o*d,t[e+2]=c*m+h*d+o*u-l*f,t[e+3]=h*m-o*f-l*u-c*d,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,i,s){return this._x=t,this._y=e,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let i=t._x,s=t._y,r=t._z,a=t._order,o=Math.cos,l=Math.sin,c=o(i/2),h=o(s/2),f=o(r/2),u=l(i/2),d=l(s/2),m=l(r/2);switch(a){case"XYZ":this._x=u*h*f+c*d*m,this._y=c*d*f-u*h*m,this._z=c*h*m+u*d*f,this._w=c*h*f-u*d*m;break;case"YXZ":this._x=u*h*f+c*d*m,this._y=c*d*f-u*h*m,this._z=c*h*m-u*d*f,this._w=c*h*f+u*d*m;break;case"ZXY":this._x=u*h*f-c*d*m,this._y=c*d*f+u*h*m,this._z=c*h*m+u*d*f,this._w=c*h*f-u*d*m;break;case"ZYX":this._x=u*h*f-c*d*m,this._y=c*d*f+u*h*m,this._z=c*h*m-u*d*f,this._w=c*h*f+u*d*m;break;case"YZX":this._x=u*h*f+c*d*m,this._y=c*d*f+u*h*m,this._z=c*h*m-u*d*f,this._w=c*h*f-u*d*m;break;case"XZY":this._x=u*h*f-c*d*m,this._y=c*d*f-u*h*m,this._z=c*h*m+u*d*f,this._w=c*h*f+u*d*m;break;default:Rt("Quaternion: .setFromEuler() encountered an unknown order: "+a)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let i=e/2,s=Math.sin(i);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,i=e[0],s=e[4],r=e[8],a=e[1],o=e[5],l=e[9],c=e[2],h=e[6],f=e[10],u=i+o+f;if(u>0){let d=.5/Math.sqrt(u+1);this._w=.25/d,this._x=(h-l)*d,this._y=(r-c)*d,this._z=(a-s)*d}else if(i>o&&i>f){let d=2*Math.sqrt(1+i-o-f);this._w=(h-l)/d,this._x=.25*d,this._y=(s+a)/d,this._z=(r+c)/d}else if(o>f){let d=2*Math.sqrt(1+o-i-f);this._w=(r-c)/d,this._x=(s+a)/d,this._y=.25*d,this._z=(l+h)/d}else{let d=2*Math.sqrt(1+f-i-o);this._w=(a-s)/d,this._x=(r+c)/d,this._y=(l+h)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let i=t.dot(e)+1;return i<1e-8?(i=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=i):(this._x=0,this._y=-t.z,this._z=t.y,this._w=i)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=i),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Ot(this.dot(t),-1,1)))}rotateTowards(t,e){let i=this.angleTo(t);if(i===0)return this;let s=Math.min(1,e/i);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let i=t._x,s=t._y,r=t._z,a=t._w,o=e._x,l=e._y,c=e._z,h=e._w;return this._x=i*h+a*o+s*c-r*l,this._y=s*h+a*l+r*o-i*c,this._z=r*h+a*c+i*l-s*o,this._w=a*h-i*o-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){let i=t._x,s=t._y,r=t._z,a=t._w,o=this.dot(t);o<0&&(i=-i,s=-s,r=-r,a=-a,o=-o);let l=1-e;if(o<.9995){let c=Math.acos(o),h=Math.sin(c);l=Math.sin(l*c)/h,e=Math.sin(e*c)/h,this._x=this._x*l+i*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+a*e,this._onChangeCallback()}else this._x=this._x*l+i*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+a*e,this.normalize();return this}slerpQuaternions(t,e,i){return this.copy(t).slerp(e,i)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},F=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,i=0){this.x=t,this.y=e,this.z=i}set(t,e,i){return i===void 0&&(i=this.z),this.x=t,this.y=e,this.z=i,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(dp.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(dp.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,i=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*i+r[6]*s,this.y=r[1]*e+r[4]*i+r[7]*s,this.z=r[2]*e+r[5]*i+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,i=this.y,s=this.z,r=t.elements,a=1/(r[3]*e+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*i+r[8]*s+r[12])*a,this.y=(r[1]*e+r[5]*i+r[9]*s+r[13])*a,this.z=(r[2]*e+r[6]*i+r[10]*s+r[14])*a,this}applyQuaternion(t){let e=this.x,i=this.y,s=this.z,r=t.x,a=t.y,o=t.z,l=t.w,c=2*(a*s-o*i),h=2*(o*e-r*s),f=2*(r*i-a*e);return this.x=e+l*c+a*f-o*h,this.y=i+l*h+o*c-r*f,this.z=s+l*f+r*h-a*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,i=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*i+r[8]*s,this.y=r[1]*e+r[5]*i+r[9]*s,this.z=r[2]*e+r[6]*i+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Ot(this.x,t.x,e.x),this.y=Ot(this.y,t.y,e.y),this.z=Ot(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=Ot(this.x,t,e),this.y=Ot(this.y,t,e),this.z=Ot(this.z,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ot(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let i=t.x,s=t.y,r=t.z,a=e.x,o=e.y,l=e.z;return this.x=s*l-r*o,this.y=r*a-i*l,this.z=i*o-s*a,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let i=t.dot(this)/e;return this.copy(t).multiplyScalar(i)}projectOnPlane(t){return Yc.copy(this).projectOnVector(t),this.sub(Yc)}reflect(t){return this.sub(Yc.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Ot(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y,s=this.z-t.z;return e*e+i*i+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,i){let s=Math.sin(e)*t;return this.x=s*Math.sin(i),this.y=Math.cos(e)*t,this.z=s*Math.cos(i),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,i){return this.x=t*Math.sin(e),this.y=i,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),i=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=i,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,i=Math.sqrt(1-e*e);return this.x=i*Math.cos(t),this.y=e,this.z=i*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Yc=new F,dp=new Vn,Lt=class{static{this.prototype.isMatrix3=!0}constructor(t,e,i,s,r,a,o,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,i,s,r,a,o,l,c)}set(t,e,i,s,r,a,o,l,c){let h=this.elements;return h[0]=t,h[1]=s,h[2]=o,h[3]=e,h[4]=r,h[5]=l,h[6]=i,h[7]=a,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],this}extractBasis(t,e,i){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,s=e.elements,r=this.elements,a=i[0],o=i[3],l=i[6],c=i[1],h=i[4],f=i[7],u=i[2],d=i[5],m=i[8],_=s[0],p=s[3],g=s[6],M=s[1],A=s[4],b=s[7],E=s[2],S=s[5],x=s[8];return r[0]=a*_+o*M+l*E,r[3]=a*p+o*A+l*S,r[6]=a*g+o*b+l*x,r[1]=c*_+h*M+f*E,r[4]=c*p+h*A+f*S,r[7]=c*g+h*b+f*x,r[2]=u*_+d*M+m*E,r[5]=u*p+d*A+m*S,r[8]=u*g+d*b+m*x,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],h=t[8];return e*a*h-e*o*c-i*r*h+i*o*l+s*r*c-s*a*l}invert(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],h=t[8],f=h*a-o*c,u=o*l-h*r,d=c*r-a*l,m=e*f+i*u+s*d;if(m===0)return this.set(0,0,0,0,0,0,0,0,0);let _=1/m;return t[0]=f*_,t[1]=(s*c-h*i)*_,t[2]=(o*i-s*a)*_,t[3]=u*_,t[4]=(h*e-s*l)*_,t[5]=(s*r-o*e)*_,t[6]=d*_,t[7]=(i*l-c*e)*_,t[8]=(a*e-i*r)*_,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,i,s,r,a,o){let l=Math.cos(r),c=Math.sin(r);return this.set(i*l,i*c,-i*(l*a+c*o)+a+t,-s*c,s*l,-s*(-c*a+l*o)+o+e,0,0,1),this}scale(t,e){return br("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Zc.makeScale(t,e)),this}rotate(t){return br("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Zc.makeRotation(-t)),this}translate(t,e){return br("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Zc.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,i,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,i=t.elements;for(let s=0;s<9;s++)if(e[s]!==i[s])return!1;return!0}fromArray(t,e=0){for(let i=0;i<9;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t}clone(){return new this.constructor().fromArray(this.elements)}},Zc=new Lt,pp=new Lt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),mp=new Lt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function Y_(){let n={enabled:!0,workingColorSpace:Zi,spaces:{},convert:function(s,r,a){return this.enabled===!1||r===a||!r||!a||(this.spaces[r].transfer===jt&&(s.r=ni(s.r),s.g=ni(s.g),s.b=ni(s.b)),this.spaces[r].primaries!==this.spaces[a].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[a].fromXYZ)),this.spaces[a].transfer===jt&&(s.r=Bs(s.r),s.g=Bs(s.g),s.b=Bs(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===ai?Ar:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,a){return s.copy(this.spaces[a].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[Zi]:{primaries:t,whitePoint:i,transfer:Ar,toXYZ:pp,fromXYZ:mp,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:nn},outputColorSpaceConfig:{drawingBufferColorSpace:nn}},[nn]:{primaries:t,whitePoint:i,transfer:jt,toXYZ:pp,fromXYZ:mp,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:nn}}}),n}var qt=Y_();function ni(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function Bs(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var Ss,Ro=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let i;if(t instanceof HTMLCanvasElement)i=t;else{Ss===void 0&&(Ss=Er("canvas")),Ss.width=t.width,Ss.height=t.height;let s=Ss.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),i=Ss}return i.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=Er("canvas");e.width=t.width,e.height=t.height;let i=e.getContext("2d");i.drawImage(t,0,0,t.width,t.height);let s=i.getImageData(0,0,t.width,t.height),r=s.data;for(let a=0;a<r.length;a++)r[a]=ni(r[a]/255)*255;return i.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let i=0;i<e.length;i++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[i]=Math.floor(ni(e[i]/255)*255):e[i]=ni(e[i]);return{data:e,width:t.width,height:t.height}}else return Rt("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},Z_=0,Gs=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:Z_++}),this.uuid=Pi(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let a=0,o=s.length;a<o;a++)s[a].isDataTexture?r.push(Jc(s[a].image)):r.push(Jc(s[a]))}else r=Jc(s);i.url=r}return e||(t.images[this.uuid]=i),i}};function Jc(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?Ro.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(Rt("Texture: Unable to serialize Texture."),{})}var J_=0,Kc=new F,Qe=class n extends zn{constructor(t=n.DEFAULT_IMAGE,e=n.DEFAULT_MAPPING,i=kn,s=kn,r=fe,a=si,o=cn,l=$e,c=n.DEFAULT_ANISOTROPY,h=ai){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:J_++}),this.uuid=Pi(),this.name="",this.source=new Gs(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=a,this.anisotropy=c,this.format=o,this.internalFormat=null,this.type=l,this.offset=new $t(0,0),this.repeat=new $t(1,1),this.center=new $t(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Lt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Kc).x}get height(){return this.source.getSize(Kc).y}get depth(){return this.source.getSize(Kc).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let i=t[e];if(i===void 0){Rt(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Rt(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),e||(t.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==Uh)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case To:t.x=t.x-Math.floor(t.x);break;case kn:t.x=t.x<0?0:1;break;case Eo:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case To:t.y=t.y-Math.floor(t.y);break;case kn:t.y=t.y<0?0:1;break;case Eo:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};Qe.DEFAULT_IMAGE=null;Qe.DEFAULT_MAPPING=Uh;Qe.DEFAULT_ANISOTROPY=1;var Kt=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,i=0,s=1){this.x=t,this.y=e,this.z=i,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,i,s){return this.x=t,this.y=e,this.z=i,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,i=this.y,s=this.z,r=this.w,a=t.elements;return this.x=a[0]*e+a[4]*i+a[8]*s+a[12]*r,this.y=a[1]*e+a[5]*i+a[9]*s+a[13]*r,this.z=a[2]*e+a[6]*i+a[10]*s+a[14]*r,this.w=a[3]*e+a[7]*i+a[11]*s+a[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,i,s,r,l=t.elements,c=l[0],h=l[4],f=l[8],u=l[1],d=l[5],m=l[9],_=l[2],p=l[6],g=l[10];if(Math.abs(h-u)<.01&&Math.abs(f-_)<.01&&Math.abs(m-p)<.01){if(Math.abs(h+u)<.1&&Math.abs(f+_)<.1&&Math.abs(m+p)<.1&&Math.abs(c+d+g-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let A=(c+1)/2,b=(d+1)/2,E=(g+1)/2,S=(h+u)/4,x=(f+_)/4,w=(m+p)/4;return A>b&&A>E?A<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(A),s=S/i,r=x/i):b>E?b<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(b),i=S/s,r=w/s):E<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(E),i=x/r,s=w/r),this.set(i,s,r,e),this}let M=Math.sqrt((p-m)*(p-m)+(f-_)*(f-_)+(u-h)*(u-h));return Math.abs(M)<.001&&(M=1),this.x=(p-m)/M,this.y=(f-_)/M,this.z=(u-h)/M,this.w=Math.acos((c+d+g-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Ot(this.x,t.x,e.x),this.y=Ot(this.y,t.y,e.y),this.z=Ot(this.z,t.z,e.z),this.w=Ot(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=Ot(this.x,t,e),this.y=Ot(this.y,t,e),this.z=Ot(this.z,t,e),this.w=Ot(this.w,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ot(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this.w=t.w+(e.w-t.w)*i,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Io=class extends zn{constructor(t=1,e=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:fe,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=i.depth,this.scissor=new Kt(0,0,t,e),this.scissorTest=!1,this.viewport=new Kt(0,0,t,e),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new Qe({width:t,height:e,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:fe,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,i=1){if(this.width!==t||this.height!==e||this.depth!==i){this.width=t,this.height=e,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,i=t.textures.length;e<i;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new Gs(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Ie=class extends Io{constructor(t=1,e=1,i={}){super(t,e,i),this.isWebGLRenderTarget=!0}},Rr=class extends Qe{constructor(t=null,e=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:i,depth:s},this.magFilter=ue,this.minFilter=ue,this.wrapR=kn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var Po=class extends Qe{constructor(t=null,e=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:i,depth:s},this.magFilter=ue,this.minFilter=ue,this.wrapR=kn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var ie=class n{static{this.prototype.isMatrix4=!0}constructor(t,e,i,s,r,a,o,l,c,h,f,u,d,m,_,p){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,i,s,r,a,o,l,c,h,f,u,d,m,_,p)}set(t,e,i,s,r,a,o,l,c,h,f,u,d,m,_,p){let g=this.elements;return g[0]=t,g[4]=e,g[8]=i,g[12]=s,g[1]=r,g[5]=a,g[9]=o,g[13]=l,g[2]=c,g[6]=h,g[10]=f,g[14]=u,g[3]=d,g[7]=m,g[11]=_,g[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],e[9]=i[9],e[10]=i[10],e[11]=i[11],e[12]=i[12],e[13]=i[13],e[14]=i[14],e[15]=i[15],this}copyPosition(t){let e=this.elements,i=t.elements;return e[12]=i[12],e[13]=i[13],e[14]=i[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,i){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),i.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(t,e,i){return this.set(t.x,e.x,i.x,0,t.y,e.y,i.y,0,t.z,e.z,i.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,i=t.elements,s=1/ws.setFromMatrixColumn(t,0).length(),r=1/ws.setFromMatrixColumn(t,1).length(),a=1/ws.setFromMatrixColumn(t,2).length();return e[0]=i[0]*s,e[1]=i[1]*s,e[2]=i[2]*s,e[3]=0,e[4]=i[4]*r,e[5]=i[5]*r,e[6]=i[6]*r,e[7]=0,e[8]=i[8]*a,e[9]=i[9]*a,e[10]=i[10]*a,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,i=t.x,s=t.y,r=t.z,a=Math.cos(i),o=Math.sin(i),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),f=Math.sin(r);if(t.order==="XYZ"){let u=a*h,d=a*f,m=o*h,_=o*f;e[0]=l*h,e[4]=-l*f,e[8]=c,e[1]=d+m*c,e[5]=u-_*c,e[9]=-o*l,e[2]=_-u*c,e[6]=m+d*c,e[10]=a*l}else if(t.order==="YXZ"){let u=l*h,d=l*f,m=c*h,_=c*f;e[0]=u+_*o,e[4]=m*o-d,e[8]=a*c,e[1]=a*f,e[5]=a*h,e[9]=-o,e[2]=d*o-m,e[6]=_+u*o,e[10]=a*l}else if(t.order==="ZXY"){let u=l*h,d=l*f,m=c*h,_=c*f;e[0]=u-_*o,e[4]=-a*f,e[8]=m+d*o,e[1]=d+m*o,e[5]=a*h,e[9]=_-u*o,e[2]=-a*c,e[6]=o,e[10]=a*l}else if(t.order==="ZYX"){let u=a*h,d=a*f,m=o*h,_=o*f;e[0]=l*h,e[4]=m*c-d,e[8]=u*c+_,e[1]=l*f,e[5]=_*c+u,e[9]=d*c-m,e[2]=-c,e[6]=o*l,e[10]=a*l}else if(t.order==="YZX"){let u=a*l,d=a*c,m=o*l,_=o*c;e[0]=l*h,e[4]=_-u*f,e[8]=m*f+d,e[1]=f,e[5]=a*h,e[9]=-o*h,e[2]=-c*h,e[6]=d*f+m,e[10]=u-_*f}else if(t.order==="XZY"){let u=a*l,d=a*c,m=o*l,_=o*c;e[0]=l*h,e[4]=-f,e[8]=c*h,e[1]=u*f+_,e[5]=a*h,e[9]=d*f-m,e[2]=m*f-d,e[6]=o*h,e[10]=_*f+u}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(K_,t,j_)}lookAt(t,e,i){let s=this.elements;return tn.subVectors(t,e),tn.lengthSq()===0&&(tn.z=1),tn.normalize(),mi.crossVectors(i,tn),mi.lengthSq()===0&&(Math.abs(i.z)===1?tn.x+=1e-4:tn.z+=1e-4,tn.normalize(),mi.crossVectors(i,tn)),mi.normalize(),$a.crossVectors(tn,mi),s[0]=mi.x,s[4]=$a.x,s[8]=tn.x,s[1]=mi.y,s[5]=$a.y,s[9]=tn.y,s[2]=mi.z,s[6]=$a.z,s[10]=tn.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,s=e.elements,r=this.elements,a=i[0],o=i[4],l=i[8],c=i[12],h=i[1],f=i[5],u=i[9],d=i[13],m=i[2],_=i[6],p=i[10],g=i[14],M=i[3],A=i[7],b=i[11],E=i[15],S=s[0],x=s[4],w=s[8],O=s[12],P=s[1],D=s[5],N=s[9],V=s[13],I=s[2],W=s[6],Y=s[10],G=s[14],tt=s[3],X=s[7],j=s[11],et=s[15];return r[0]=a*S+o*P+l*I+c*tt,r[4]=a*x+o*D+l*W+c*X,r[8]=a*w+o*N+l*Y+c*j,r[12]=a*O+o*V+l*G+c*et,r[1]=h*S+f*P+u*I+d*tt,r[5]=h*x+f*D+u*W+d*X,r[9]=h*w+f*N+u*Y+d*j,r[13]=h*O+f*V+u*G+d*et,r[2]=m*S+_*P+p*I+g*tt,r[6]=m*x+_*D+p*W+g*X,r[10]=m*w+_*N+p*Y+g*j,r[14]=m*O+_*V+p*G+g*et,r[3]=M*S+A*P+b*I+E*tt,r[7]=M*x+A*D+b*W+E*X,r[11]=M*w+A*N+b*Y+E*j,r[15]=M*O+A*V+b*G+E*et,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[4],s=t[8],r=t[12],a=t[1],o=t[5],l=t[9],c=t[13],h=t[2],f=t[6],u=t[10],d=t[14],m=t[3],_=t[7],p=t[11],g=t[15],M=l*d-c*u,A=o*d-c*f,b=o*u-l*f,E=a*d-c*h,S=a*u-l*h,x=a*f-o*h;return e*(_*M-p*A+g*b)-i*(m*M-p*E+g*S)+s*(m*A-_*E+g*x)-r*(m*b-_*S+p*x)}determinantAffine(){let t=this.elements,e=t[0],i=t[4],s=t[8],r=t[1],a=t[5],o=t[9],l=t[2],c=t[6],h=t[10];return e*(a*h-o*c)-i*(r*h-o*l)+s*(r*c-a*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,i){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=i),this}invert(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],h=t[8],f=t[9],u=t[10],d=t[11],m=t[12],_=t[13],p=t[14],g=t[15],M=e*o-i*a,A=e*l-s*a,b=e*c-r*a,E=i*l-s*o,S=i*c-r*o,x=s*c-r*l,w=h*_-f*m,O=h*p-u*m,P=h*g-d*m,D=f*p-u*_,N=f*g-d*_,V=u*g-d*p,I=M*V-A*N+b*D+E*P-S*O+x*w;if(I===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let W=1/I;return t[0]=(o*V-l*N+c*D)*W,t[1]=(s*N-i*V-r*D)*W,t[2]=(_*x-p*S+g*E)*W,t[3]=(u*S-f*x-d*E)*W,t[4]=(l*P-a*V-c*O)*W,t[5]=(e*V-s*P+r*O)*W,t[6]=(p*b-m*x-g*A)*W,t[7]=(h*x-u*b+d*A)*W,t[8]=(a*N-o*P+c*w)*W,t[9]=(i*P-e*N-r*w)*W,t[10]=(m*S-_*b+g*M)*W,t[11]=(f*b-h*S-d*M)*W,t[12]=(o*O-a*D-l*w)*W,t[13]=(e*D-i*O+s*w)*W,t[14]=(_*A-m*E-p*M)*W,t[15]=(h*E-f*A+u*M)*W,this}scale(t){let e=this.elements,i=t.x,s=t.y,r=t.z;return e[0]*=i,e[4]*=s,e[8]*=r,e[1]*=i,e[5]*=s,e[9]*=r,e[2]*=i,e[6]*=s,e[10]*=r,e[3]*=i,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],i=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,i,s))}makeTranslation(t,e,i){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,i,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),i=Math.sin(t);return this.set(1,0,0,0,0,e,-i,0,0,i,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,0,i,0,0,1,0,0,-i,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,0,i,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let i=Math.cos(e),s=Math.sin(e),r=1-i,a=t.x,o=t.y,l=t.z,c=r*a,h=r*o;return this.set(c*a+i,c*o-s*l,c*l+s*o,0,c*o+s*l,h*o+i,h*l-s*a,0,c*l-s*o,h*l+s*a,r*l*l+i,0,0,0,0,1),this}makeScale(t,e,i){return this.set(t,0,0,0,0,e,0,0,0,0,i,0,0,0,0,1),this}makeShear(t,e,i,s,r,a){return this.set(1,i,r,0,t,1,a,0,e,s,1,0,0,0,0,1),this}compose(t,e,i){let s=this.elements,r=e._x,a=e._y,o=e._z,l=e._w,c=r+r,h=a+a,f=o+o,u=r*c,d=r*h,m=r*f,_=a*h,p=a*f,g=o*f,M=l*c,A=l*h,b=l*f,E=i.x,S=i.y,x=i.z;return s[0]=(1-(_+g))*E,s[1]=(d+b)*E,s[2]=(m-A)*E,s[3]=0,s[4]=(d-b)*S,s[5]=(1-(u+g))*S,s[6]=(p+M)*S,s[7]=0,s[8]=(m+A)*x,s[9]=(p-M)*x,s[10]=(1-(u+_))*x,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,i){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),e.identity(),this;let a=ws.set(s[0],s[1],s[2]).length(),o=ws.set(s[4],s[5],s[6]).length(),l=ws.set(s[8],s[9],s[10]).length();r<0&&(a=-a),wn.copy(this);let c=1/a,h=1/o,f=1/l;return wn.elements[0]*=c,wn.elements[1]*=c,wn.elements[2]*=c,wn.elements[4]*=h,wn.elements[5]*=h,wn.elements[6]*=h,wn.elements[8]*=f,wn.elements[9]*=f,wn.elements[10]*=f,e.setFromRotationMatrix(wn),i.x=a,i.y=o,i.z=l,this}makePerspective(t,e,i,s,r,a,o=_n,l=!1){let c=this.elements,h=2*r/(e-t),f=2*r/(i-s),u=(e+t)/(e-t),d=(i+s)/(i-s),m,_;if(l)m=r/(a-r),_=a*r/(a-r);else if(o===_n)m=-(a+r)/(a-r),_=-2*a*r/(a-r);else if(o===Tr)m=-a/(a-r),_=-a*r/(a-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+o);return c[0]=h,c[4]=0,c[8]=u,c[12]=0,c[1]=0,c[5]=f,c[9]=d,c[13]=0,c[2]=0,c[6]=0,c[10]=m,c[14]=_,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,i,s,r,a,o=_n,l=!1){let c=this.elements,h=2/(e-t),f=2/(i-s),u=-(e+t)/(e-t),d=-(i+s)/(i-s),m,_;if(l)m=1/(a-r),_=a/(a-r);else if(o===_n)m=-2/(a-r),_=-(a+r)/(a-r);else if(o===Tr)m=-1/(a-r),_=-r/(a-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+o);return c[0]=h,c[4]=0,c[8]=0,c[12]=u,c[1]=0,c[5]=f,c[9]=0,c[13]=d,c[2]=0,c[6]=0,c[10]=m,c[14]=_,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,i=t.elements;for(let s=0;s<16;s++)if(e[s]!==i[s])return!1;return!0}fromArray(t,e=0){for(let i=0;i<16;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t[e+9]=i[9],t[e+10]=i[10],t[e+11]=i[11],t[e+12]=i[12],t[e+13]=i[13],t[e+14]=i[14],t[e+15]=i[15],t}},ws=new F,wn=new ie,K_=new F(0,0,0),j_=new F(1,1,1),mi=new F,$a=new F,tn=new F,gp=new ie,xp=new Vn,bi=class n{constructor(t=0,e=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=i,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,i,s=this._order){return this._x=t,this._y=e,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,i=!0){let s=t.elements,r=s[0],a=s[4],o=s[8],l=s[1],c=s[5],h=s[9],f=s[2],u=s[6],d=s[10];switch(e){case"XYZ":this._y=Math.asin(Ot(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(-h,d),this._z=Math.atan2(-a,r)):(this._x=Math.atan2(u,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Ot(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(o,d),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-f,r),this._z=0);break;case"ZXY":this._x=Math.asin(Ot(u,-1,1)),Math.abs(u)<.9999999?(this._y=Math.atan2(-f,d),this._z=Math.atan2(-a,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Ot(f,-1,1)),Math.abs(f)<.9999999?(this._x=Math.atan2(u,d),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-a,c));break;case"YZX":this._z=Math.asin(Ot(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-f,r)):(this._x=0,this._y=Math.atan2(o,d));break;case"XZY":this._z=Math.asin(-Ot(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(u,c),this._y=Math.atan2(o,r)):(this._x=Math.atan2(-h,d),this._y=0);break;default:Rt("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,i===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,i){return gp.makeRotationFromQuaternion(t),this.setFromRotationMatrix(gp,e,i)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return xp.setFromEuler(this),this.setFromQuaternion(xp,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};bi.DEFAULT_ORDER="XYZ";var Ir=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},Q_=0,_p=new F,As=new Vn,Kn=new ie,Ya=new F,xr=new F,ty=new F,ey=new Vn,yp=new F(1,0,0),vp=new F(0,1,0),bp=new F(0,0,1),Mp={type:"added"},ny={type:"removed"},Ts={type:"childadded",child:null},jc={type:"childremoved",child:null},sn=class n extends zn{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:Q_++}),this.uuid=Pi(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let t=new F,e=new bi,i=new Vn,s=new F(1,1,1);function r(){i.setFromEuler(e,!1)}function a(){e.setFromQuaternion(i,void 0,!1)}e._onChange(r),i._onChange(a),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new ie},normalMatrix:{value:new Lt}}),this.matrix=new ie,this.matrixWorld=new ie,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Ir,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return As.setFromAxisAngle(t,e),this.quaternion.multiply(As),this}rotateOnWorldAxis(t,e){return As.setFromAxisAngle(t,e),this.quaternion.premultiply(As),this}rotateX(t){return this.rotateOnAxis(yp,t)}rotateY(t){return this.rotateOnAxis(vp,t)}rotateZ(t){return this.rotateOnAxis(bp,t)}translateOnAxis(t,e){return _p.copy(t).applyQuaternion(this.quaternion),this.position.add(_p.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(yp,t)}translateY(t){return this.translateOnAxis(vp,t)}translateZ(t){return this.translateOnAxis(bp,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Kn.copy(this.matrixWorld).invert())}lookAt(t,e,i){t.isVector3?Ya.copy(t):Ya.set(t,e,i);let s=this.parent;this.updateWorldMatrix(!0,!1),xr.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Kn.lookAt(xr,Ya,this.up):Kn.lookAt(Ya,xr,this.up),this.quaternion.setFromRotationMatrix(Kn),s&&(Kn.extractRotation(s.matrixWorld),As.setFromRotationMatrix(Kn),this.quaternion.premultiply(As.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Pt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Mp),Ts.child=t,this.dispatchEvent(Ts),Ts.child=null):Pt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(ny),jc.child=t,this.dispatchEvent(jc),jc.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Kn.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Kn.multiply(t.parent.matrixWorld)),t.applyMatrix4(Kn),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Mp),Ts.child=t,this.dispatchEvent(Ts),Ts.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let i=0,s=this.children.length;i<s;i++){let a=this.children[i].getObjectByProperty(t,e);if(a!==void 0)return a}}getObjectsByProperty(t,e,i=[]){this[t]===e&&i.push(this);let s=this.children;for(let r=0,a=s.length;r<a;r++)s[r].getObjectsByProperty(t,e,i);return i}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(xr,t,ty),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(xr,ey,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,i=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*i-r[8]*s,r[13]+=i-r[1]*e-r[5]*i-r[9]*s,r[14]+=s-r[2]*e-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].updateMatrixWorld(t)}updateWorldMatrix(t,e,i=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),e===!0){let r=this.children;for(let a=0,o=r.length;a<o;a++)r[a].updateWorldMatrix(!1,!0,i)}}toJSON(t){let e=t===void 0||typeof t=="string",i={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(o=>({...o,boundingBox:o.boundingBox?o.boundingBox.toJSON():void 0,boundingSphere:o.boundingSphere?o.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(o=>({...o})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(o,l){return o[l.uuid]===void 0&&(o[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let o=this.geometry.parameters;if(o!==void 0&&o.shapes!==void 0){let l=o.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let f=l[c];r(t.shapes,f)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let o=[];for(let l=0,c=this.material.length;l<c;l++)o.push(r(t.materials,this.material[l]));s.material=o}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let o=0;o<this.children.length;o++)s.children.push(this.children[o].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let o=0;o<this.animations.length;o++){let l=this.animations[o];s.animations.push(r(t.animations,l))}}if(e){let o=a(t.geometries),l=a(t.materials),c=a(t.textures),h=a(t.images),f=a(t.shapes),u=a(t.skeletons),d=a(t.animations),m=a(t.nodes);o.length>0&&(i.geometries=o),l.length>0&&(i.materials=l),c.length>0&&(i.textures=c),h.length>0&&(i.images=h),f.length>0&&(i.shapes=f),u.length>0&&(i.skeletons=u),d.length>0&&(i.animations=d),m.length>0&&(i.nodes=m)}return i.object=s,i;function a(o){let l=[];for(let c in o){let h=o[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let i=0;i<t.children.length;i++){let s=t.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};sn.DEFAULT_UP=new F(0,1,0);sn.DEFAULT_MATRIX_AUTO_UPDATE=!0;sn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Yi=class extends sn{constructor(){super(),this.isGroup=!0,this.type="Group"}},iy={type:"move"},Hs=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Yi,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Yi,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new F,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new F),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Yi,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new F,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new F,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let i of t.hand.values())this._getHandJoint(e,i)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,i){let s=null,r=null,a=null,o=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){a=!0;for(let _ of t.hand.values()){let p=e.getJointPose(_,i),g=this._getHandJoint(c,_);p!==null&&(g.matrix.fromArray(p.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=p.radius),g.visible=p!==null}let h=c.joints["index-finger-tip"],f=c.joints["thumb-tip"],u=h.position.distanceTo(f.position),d=.02,m=.005;c.inputState.pinching&&u>d+m?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&u<=d-m&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,i),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));o!==null&&(s=e.getPose(t.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(o.matrix.fromArray(s.transform.matrix),o.matrix.decompose(o.position,o.quaternion,o.scale),o.matrixWorldNeedsUpdate=!0,s.linearVelocity?(o.hasLinearVelocity=!0,o.linearVelocity.copy(s.linearVelocity)):o.hasLinearVelocity=!1,s.angularVelocity?(o.hasAngularVelocity=!0,o.angularVelocity.copy(s.angularVelocity)):o.hasAngularVelocity=!1,this.dispatchEvent(iy)))}return o!==null&&(o.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=a!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let i=new Yi;i.matrixAutoUpdate=!1,i.visible=!1,t.joints[e.jointName]=i,t.add(i)}return t.joints[e.jointName]}},vm={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},gi={h:0,s:0,l:0},Za={h:0,s:0,l:0};function Qc(n,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?n+(t-n)*6*e:e<1/2?t:e<2/3?n+(t-n)*6*(2/3-e):n}var Yt=class{constructor(t,e,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,i)}set(t,e,i){if(e===void 0&&i===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,i);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=nn){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,qt.colorSpaceToWorking(this,e),this}setRGB(t,e,i,s=qt.workingColorSpace){return this.r=t,this.g=e,this.b=i,qt.colorSpaceToWorking(this,s),this}setHSL(t,e,i,s=qt.workingColorSpace){if(t=$h(t,1),e=Ot(e,0,1),i=Ot(i,0,1),e===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+e):i+e-i*e,a=2*i-r;this.r=Qc(a,r,t+1/3),this.g=Qc(a,r,t),this.b=Qc(a,r,t-1/3)}return qt.colorSpaceToWorking(this,s),this}setStyle(t,e=nn){function i(r){r!==void 0&&parseFloat(r)<1&&Rt("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,a=s[1],o=s[2];switch(a){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:Rt("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],a=r.length;if(a===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(a===6)return this.setHex(parseInt(r,16),e);Rt("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=nn){let i=vm[t.toLowerCase()];return i!==void 0?this.setHex(i,e):Rt("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=ni(t.r),this.g=ni(t.g),this.b=ni(t.b),this}copyLinearToSRGB(t){return this.r=Bs(t.r),this.g=Bs(t.g),this.b=Bs(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=nn){return qt.workingToColorSpace(Be.copy(this),t),Math.round(Ot(Be.r*255,0,255))*65536+Math.round(Ot(Be.g*255,0,255))*256+Math.round(Ot(Be.b*255,0,255))}getHexString(t=nn){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=qt.workingColorSpace){qt.workingToColorSpace(Be.copy(this),e);let i=Be.r,s=Be.g,r=Be.b,a=Math.max(i,s,r),o=Math.min(i,s,r),l,c,h=(o+a)/2;if(o===a)l=0,c=0;else{let f=a-o;switch(c=h<=.5?f/(a+o):f/(2-a-o),a){case i:l=(s-r)/f+(s<r?6:0);break;case s:l=(r-i)/f+2;break;case r:l=(i-s)/f+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=qt.workingColorSpace){return qt.workingToColorSpace(Be.copy(this),e),t.r=Be.r,t.g=Be.g,t.b=Be.b,t}getStyle(t=nn){qt.workingToColorSpace(Be.copy(this),t);let e=Be.r,i=Be.g,s=Be.b;return t!==nn?`color(${t} ${e.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(t,e,i){return this.getHSL(gi),this.setHSL(gi.h+t,gi.s+e,gi.l+i)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,i){return this.r=t.r+(e.r-t.r)*i,this.g=t.g+(e.g-t.g)*i,this.b=t.b+(e.b-t.b)*i,this}lerpHSL(t,e){this.getHSL(gi),t.getHSL(Za);let i=Sr(gi.h,Za.h,e),s=Sr(gi.s,Za.s,e),r=Sr(gi.l,Za.l,e);return this.setHSL(i,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,i=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*i+r[6]*s,this.g=r[1]*e+r[4]*i+r[7]*s,this.b=r[2]*e+r[5]*i+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Be=new Yt;Yt.NAMES=vm;var Mi=class extends sn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new bi,this.environmentIntensity=1,this.environmentRotation=new bi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},An=new F,jn=new F,th=new F,Qn=new F,Es=new F,Cs=new F,Sp=new F,eh=new F,nh=new F,ih=new F,sh=new Kt,rh=new Kt,ah=new Kt,vi=class n{constructor(t=new F,e=new F,i=new F){this.a=t,this.b=e,this.c=i}static getNormal(t,e,i,s){s.subVectors(i,e),An.subVectors(t,e),s.cross(An);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,i,s,r){An.subVectors(s,e),jn.subVectors(i,e),th.subVectors(t,e);let a=An.dot(An),o=An.dot(jn),l=An.dot(th),c=jn.dot(jn),h=jn.dot(th),f=a*c-o*o;if(f===0)return r.set(0,0,0),null;let u=1/f,d=(c*l-o*h)*u,m=(a*h-o*l)*u;return r.set(1-d-m,m,d)}static containsPoint(t,e,i,s){return this.getBarycoord(t,e,i,s,Qn)===null?!1:Qn.x>=0&&Qn.y>=0&&Qn.x+Qn.y<=1}static getInterpolation(t,e,i,s,r,a,o,l){return this.getBarycoord(t,e,i,s,Qn)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Qn.x),l.addScaledVector(a,Qn.y),l.addScaledVector(o,Qn.z),l)}static getInterpolatedAttribute(t,e,i,s,r,a){return sh.setScalar(0),rh.setScalar(0),ah.setScalar(0),sh.fromBufferAttribute(t,e),rh.fromBufferAttribute(t,i),ah.fromBufferAttribute(t,s),a.setScalar(0),a.addScaledVector(sh,r.x),a.addScaledVector(rh,r.y),a.addScaledVector(ah,r.z),a}static isFrontFacing(t,e,i,s){return An.subVectors(i,e),jn.subVectors(t,e),An.cross(jn).dot(s)<0}set(t,e,i){return this.a.copy(t),this.b.copy(e),this.c.copy(i),this}setFromPointsAndIndices(t,e,i,s){return this.a.copy(t[e]),this.b.copy(t[i]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,i,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,i),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return An.subVectors(this.c,this.b),jn.subVectors(this.a,this.b),An.cross(jn).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return n.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return n.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,i,s,r){return n.getInterpolation(t,this.a,this.b,this.c,e,i,s,r)}containsPoint(t){return n.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return n.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let i=this.a,s=this.b,r=this.c,a,o;Es.subVectors(s,i),Cs.subVectors(r,i),eh.subVectors(t,i);let l=Es.dot(eh),c=Cs.dot(eh);if(l<=0&&c<=0)return e.copy(i);nh.subVectors(t,s);let h=Es.dot(nh),f=Cs.dot(nh);if(h>=0&&f<=h)return e.copy(s);let u=l*f-h*c;if(u<=0&&l>=0&&h<=0&&l-h>0)return a=l/(l-h),e.copy(i).addScaledVector(Es,a);ih.subVectors(t,r);let d=Es.dot(ih),m=Cs.dot(ih);if(m>=0&&d<=m)return e.copy(r);let _=d*c-l*m;if(_<=0&&c>=0&&m<=0)return o=c/(c-m),e.copy(i).addScaledVector(Cs,o);let p=h*m-d*f;if(p<=0&&f-h>=0&&d-m>=0)return Sp.subVectors(r,s),o=(f-h)/(f-h+(d-m)),e.copy(s).addScaledVector(Sp,o);let g=1/(p+_+u);return a=_*g,o=u*g,e.copy(i).addScaledVector(Es,a).addScaledVector(Cs,o)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},rn=class{constructor(t=new F(1/0,1/0,1/0),e=new F(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e+=3)this.expandByPoint(Tn.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,i=t.count;e<i;e++)this.expandByPoint(Tn.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let i=Tn.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(i),this.max.copy(t).add(i),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let i=t.geometry;if(i!==void 0){let r=i.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let a=0,o=r.count;a<o;a++)t.isMesh===!0?t.getVertexPosition(a,Tn):Tn.fromBufferAttribute(r,a),Tn.applyMatrix4(t.matrixWorld),this.expandByPoint(Tn);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),Ja.copy(t.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),Ja.copy(i.boundingBox)),Ja.applyMatrix4(t.matrixWorld),this.union(Ja)}let s=t.children;for(let r=0,a=s.length;r<a;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,Tn),Tn.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,i;return t.normal.x>0?(e=t.normal.x*this.min.x,i=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,i=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,i+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,i+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,i+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,i+=t.normal.z*this.min.z),e<=-t.constant&&i>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(_r),Ka.subVectors(this.max,_r),Rs.subVectors(t.a,_r),Is.subVectors(t.b,_r),Ps.subVectors(t.c,_r),xi.subVectors(Is,Rs),_i.subVectors(Ps,Is),Wi.subVectors(Rs,Ps);let e=[0,-xi.z,xi.y,0,-_i.z,_i.y,0,-Wi.z,Wi.y,xi.z,0,-xi.x,_i.z,0,-_i.x,Wi.z,0,-Wi.x,-xi.y,xi.x,0,-_i.y,_i.x,0,-Wi.y,Wi.x,0];return!oh(e,Rs,Is,Ps,Ka)||(e=[1,0,0,0,1,0,0,0,1],!oh(e,Rs,Is,Ps,Ka))?!1:(ja.crossVectors(xi,_i),e=[ja.x,ja.y,ja.z],oh(e,Rs,Is,Ps,Ka))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,Tn).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(Tn).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(ti[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),ti[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),ti[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),ti[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),ti[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),ti[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),ti[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),ti[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(ti),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},ti=[new F,new F,new F,new F,new F,new F,new F,new F],Tn=new F,Ja=new rn,Rs=new F,Is=new F,Ps=new F,xi=new F,_i=new F,Wi=new F,_r=new F,Ka=new F,ja=new F,Xi=new F;function oh(n,t,e,i,s){for(let r=0,a=n.length-3;r<=a;r+=3){Xi.fromArray(n,r);let o=s.x*Math.abs(Xi.x)+s.y*Math.abs(Xi.y)+s.z*Math.abs(Xi.z),l=t.dot(Xi),c=e.dot(Xi),h=i.dot(Xi);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>o)return!1}return!0}var xe=new F,Qa=new $t,sy=0,re=class extends zn{constructor(t,e,i=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:sy++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=i,this.usage=qh,this.updateRanges=[],this.gpuType=Rn,this.version=0,this._normalizationScale=t!==void 0?Ul(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,i){t*=this.itemSize,i*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[i+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,i=this.count;e<i;e++)Qa.fromBufferAttribute(this,e),Qa.applyMatrix3(t),this.setXY(e,Qa.x,Qa.y);else if(this.itemSize===3)for(let e=0,i=this.count;e<i;e++)xe.fromBufferAttribute(this,e),xe.applyMatrix3(t),this.setXYZ(e,xe.x,xe.y,xe.z);return this}applyMatrix4(t){for(let e=0,i=this.count;e<i;e++)xe.fromBufferAttribute(this,e),xe.applyMatrix4(t),this.setXYZ(e,xe.x,xe.y,xe.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)xe.fromBufferAttribute(this,e),xe.applyNormalMatrix(t),this.setXYZ(e,xe.x,xe.y,xe.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)xe.fromBufferAttribute(this,e),xe.transformDirection(t),this.setXYZ(e,xe.x,xe.y,xe.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let i=this.array[t*this.itemSize+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.array[t*this.itemSize+e]=i,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,i){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.array[t+0]=e,this.array[t+1]=i,this}setXYZ(t,e,i,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=s,this}setXYZW(t,e,i,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):Zh(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Jh(t,this.array)}};var Pr=class extends re{constructor(t,e,i){super(new Uint16Array(t),e,i)}};var Lr=class extends re{constructor(t,e,i){super(new Uint32Array(t),e,i)}};var ke=class extends re{constructor(t,e,i){super(new Float32Array(t),e,i)}},ry=new rn,yr=new F,lh=new F,an=class{constructor(t=new F,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let i=this.center;e!==void 0?i.copy(e):ry.setFromPoints(t).getCenter(i);let s=0;for(let r=0,a=t.length;r<a;r++)s=Math.max(s,i.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let i=this.center.distanceToSquared(t);return e.copy(t),i>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;yr.subVectors(t,this.center);let e=yr.lengthSq();if(e>this.radius*this.radius){let i=Math.sqrt(e),s=(i-this.radius)*.5;this.center.addScaledVector(yr,s/i),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(lh.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(yr.copy(t.center).add(lh)),this.expandByPoint(yr.copy(t.center).sub(lh))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},ay=0,xn=new ie,ch=new sn,Ls=new F,en=new rn,vr=new rn,Ee=new F,ve=class n extends zn{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:ay++}),this.uuid=Pi(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(P_(t)?Lr:Pr)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,i=0){this.groups.push({start:t,count:e,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new Lt().getNormalMatrix(t);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return xn.makeRotationFromQuaternion(t),this.applyMatrix4(xn),this}rotateX(t){return xn.makeRotationX(t),this.applyMatrix4(xn),this}rotateY(t){return xn.makeRotationY(t),this.applyMatrix4(xn),this}rotateZ(t){return xn.makeRotationZ(t),this.applyMatrix4(xn),this}translate(t,e,i){return xn.makeTranslation(t,e,i),this.applyMatrix4(xn),this}scale(t,e,i){return xn.makeScale(t,e,i),this.applyMatrix4(xn),this}lookAt(t){return ch.lookAt(t),ch.updateMatrix(),this.applyMatrix4(ch.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Ls).negate(),this.translate(Ls.x,Ls.y,Ls.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let i=[];for(let s=0,r=t.length;s<r;s++){let a=t[s];i.push(a.x,a.y,a.z||0)}this.setAttribute("position",new ke(i,3))}else{let i=Math.min(t.length,e.count);for(let s=0;s<i;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&Rt("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new rn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Pt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new F(-1/0,-1/0,-1/0),new F(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let i=0,s=e.length;i<s;i++){let r=e[i];en.setFromBufferAttribute(r),this.morphTargetsRelative?(Ee.addVectors(this.boundingBox.min,en.min),this.boundingBox.expandByPoint(Ee),Ee.addVectors(this.boundingBox.max,en.max),this.boundingBox.expandByPoint(Ee)):(this.boundingBox.expandByPoint(en.min),this.boundingBox.expandByPoint(en.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Pt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new an);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Pt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new F,1/0);return}if(t){let i=this.boundingSphere.center;if(en.setFromBufferAttribute(t),e)for(let r=0,a=e.length;r<a;r++){let o=e[r];vr.setFromBufferAttribute(o),this.morphTargetsRelative?(Ee.addVectors(en.min,vr.min),en.expandByPoint(Ee),Ee.addVectors(en.max,vr.max),en.expandByPoint(Ee)):(en.expandByPoint(vr.min),en.expandByPoint(vr.max))}en.getCenter(i);let s=0;for(let r=0,a=t.count;r<a;r++)Ee.fromBufferAttribute(t,r),s=Math.max(s,i.distanceToSquared(Ee));if(e)for(let r=0,a=e.length;r<a;r++){let o=e[r],l=this.morphTargetsRelative;for(let c=0,h=o.count;c<h;c++)Ee.fromBufferAttribute(o,c),l&&(Ls.fromBufferAttribute(t,c),Ee.add(Ls)),s=Math.max(s,i.distanceToSquared(Ee))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Pt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Pt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=e.position,s=e.normal,r=e.uv,a=this.getAttribute("tangent");(a===void 0||a.count!==i.count)&&(a=new re(new Float32Array(4*i.count),4),this.setAttribute("tangent",a));let o=[],l=[],c=new Uint8Array(i.count);for(let O=0;O<i.count;O++)o[O]=new F,l[O]=new F;let h=new F,f=new F,u=new F,d=new $t,m=new $t,_=new $t,p=new F,g=new F;function M(O,P,D){c[O]=c[P]=c[D]=1,h.fromBufferAttribute(i,O),f.fromBufferAttribute(i,P),u.fromBufferAttribute(i,D),d.fromBufferAttribute(r,O),m.fromBufferAttribute(r,P),_.fromBufferAttribute(r,D),f.sub(h),u.sub(h),m.sub(d),_.sub(d);let N=1/(m.x*_.y-_.x*m.y);isFinite(N)&&(p.copy(f).multiplyScalar(_.y).addScaledVector(u,-m.y).multiplyScalar(N),g.copy(u).multiplyScalar(m.x).addScaledVector(f,-_.x).multiplyScalar(N),o[O].add(p),o[P].add(p),o[D].add(p),l[O].add(g),l[P].add(g),l[D].add(g))}let A=this.groups;A.length===0&&(A=[{start:0,count:t.count}]);for(let O=0,P=A.length;O<P;++O){let D=A[O],N=D.start,V=D.count;for(let I=N,W=N+V;I<W;I+=3)M(t.getX(I+0),t.getX(I+1),t.getX(I+2))}let b=new F,E=new F,S=new F,x=new F;function w(O){S.fromBufferAttribute(s,O),x.copy(S);let P=o[O];b.copy(P),b.sub(S.multiplyScalar(S.dot(P))).normalize(),E.crossVectors(x,P);let N=E.dot(l[O])<0?-1:1;a.setXYZW(O,b.x,b.y,b.z,N)}for(let O=0,P=i.count;O<P;++O)c[O]&&w(O);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==e.count)i=new re(new Float32Array(e.count*3),3),this.setAttribute("normal",i);else for(let u=0,d=i.count;u<d;u++)i.setXYZ(u,0,0,0);let s=new F,r=new F,a=new F,o=new F,l=new F,c=new F,h=new F,f=new F;if(t)for(let u=0,d=t.count;u<d;u+=3){let m=t.getX(u+0),_=t.getX(u+1),p=t.getX(u+2);s.fromBufferAttribute(e,m),r.fromBufferAttribute(e,_),a.fromBufferAttribute(e,p),h.subVectors(a,r),f.subVectors(s,r),h.cross(f),o.fromBufferAttribute(i,m),l.fromBufferAttribute(i,_),c.fromBufferAttribute(i,p),o.add(h),l.add(h),c.add(h),i.setXYZ(m,o.x,o.y,o.z),i.setXYZ(_,l.x,l.y,l.z),i.setXYZ(p,c.x,c.y,c.z)}else for(let u=0,d=e.count;u<d;u+=3)s.fromBufferAttribute(e,u+0),r.fromBufferAttribute(e,u+1),a.fromBufferAttribute(e,u+2),h.subVectors(a,r),f.subVectors(s,r),h.cross(f),i.setXYZ(u+0,h.x,h.y,h.z),i.setXYZ(u+1,h.x,h.y,h.z),i.setXYZ(u+2,h.x,h.y,h.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,i=t.count;e<i;e++)Ee.fromBufferAttribute(t,e),Ee.normalize(),t.setXYZ(e,Ee.x,Ee.y,Ee.z)}toNonIndexed(){function t(o,l){let c=o.array,h=o.itemSize,f=o.normalized,u=new c.constructor(l.length*h),d=0,m=0;for(let _=0,p=l.length;_<p;_++){o.isInterleavedBufferAttribute?d=l[_]*o.data.stride+o.offset:d=l[_]*h;for(let g=0;g<h;g++)u[m++]=c[d++]}return new re(u,h,f)}if(this.index===null)return Rt("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new n,i=this.index.array,s=this.attributes;for(let o in s){let l=s[o],c=t(l,i);e.setAttribute(o,c)}let r=this.morphAttributes;for(let o in r){let l=[],c=r[o];for(let h=0,f=c.length;h<f;h++){let u=c[h],d=t(u,i);l.push(d)}e.morphAttributes[o]=l}e.morphTargetsRelative=this.morphTargetsRelative;let a=this.groups;for(let o=0,l=a.length;o<l;o++){let c=a[o];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let i=this.attributes;for(let l in i){let c=i[l];t.data.attributes[l]=c.toJSON(t.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let f=0,u=c.length;f<u;f++){let d=c[f];h.push(d.toJSON(t.data))}h.length>0&&(s[l]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let a=this.groups;a.length>0&&(t.data.groups=JSON.parse(JSON.stringify(a)));let o=this.boundingSphere;return o!==null&&(t.data.boundingSphere=o.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let i=t.index;i!==null&&this.setIndex(i.clone());let s=t.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(e))}let r=t.morphAttributes;for(let c in r){let h=[],f=r[c];for(let u=0,d=f.length;u<d;u++)h.push(f[u].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;let a=t.groups;for(let c=0,h=a.length;c<h;c++){let f=a[c];this.addGroup(f.start,f.count,f.materialIndex)}let o=t.boundingBox;o!==null&&(this.boundingBox=o.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},Lo=class{constructor(t,e){this.isInterleavedBuffer=!0,this.array=t,this.stride=e,this.count=t!==void 0?t.length/e:0,this.usage=qh,this.updateRanges=[],this.version=0,this.uuid=Pi()}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.array=new t.array.constructor(t.array),this.count=t.count,this.stride=t.stride,this.usage=t.usage,this}copyAt(t,e,i){t*=this.stride,i*=e.stride;for(let s=0,r=this.stride;s<r;s++)this.array[t+s]=e.array[i+s];return this}set(t,e=0){return this.array.set(t,e),this}clone(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=wp(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=this.array.slice(0).buffer);let i=new this.array.constructor(t.arrayBuffers[e]),s=new this.constructor(i,this.stride);return s.setUsage(this.usage),s}onUpload(t){return this.onUploadCallback=t,this}toJSON(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=wp(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let i={uuid:this.uuid,buffer:e,type:this.array.constructor.name,stride:this.stride};return i.usage=this.usage,i}};function wp(n){return n.buffer._uuid===void 0&&(n.buffer._uuid=Pi()),n.byteOffset===0&&n.byteLength===n.buffer.byteLength?n.buffer._uuid:n.buffer._uuid+":"+n.byteOffset+":"+n.byteLength}var We=new F,Cn=class n{constructor(t,e,i,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=t,this.itemSize=e,this.offset=i,this.normalized=s,this._normalizationScale=t!==void 0?Ul(t.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(t){this.data.needsUpdate=t}applyMatrix4(t){for(let e=0,i=this.data.count;e<i;e++)We.fromBufferAttribute(this,e),We.applyMatrix4(t),this.setXYZ(e,We.x,We.y,We.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)We.fromBufferAttribute(this,e),We.applyNormalMatrix(t),this.setXYZ(e,We.x,We.y,We.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)We.fromBufferAttribute(this,e),We.transformDirection(t),this.setXYZ(e,We.x,We.y,We.z);return this}getComponent(t,e){let i=this.array[t*this.data.stride+this.offset+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.data.array[t*this.data.stride+this.offset+e]=i,this}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset]=e,this}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+1]=e,this}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+2]=e,this}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+3]=e,this}getX(t){let e=this.data.array[t*this.data.stride+this.offset];return this.normalized&&(e=this._denormalize(e)),e}getY(t){let e=this.data.array[t*this.data.stride+this.offset+1];return this.normalized&&(e=this._denormalize(e)),e}getZ(t){let e=this.data.array[t*this.data.stride+this.offset+2];return this.normalized&&(e=this._denormalize(e)),e}getW(t){let e=this.data.array[t*this.data.stride+this.offset+3];return this.normalized&&(e=this._denormalize(e)),e}setXY(t,e,i){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.data.array[t+0]=e,this.data.array[t+1]=i,this}setXYZ(t,e,i,s){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s)),this.data.array[t+0]=e,this.data.array[t+1]=i,this.data.array[t+2]=s,this}setXYZW(t,e,i,s,r){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.data.array[t+0]=e,this.data.array[t+1]=i,this.data.array[t+2]=s,this.data.array[t+3]=r,this}clone(t){if(t===void 0){Cr("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[s+r])}return new re(new this.array.constructor(e),this.itemSize,this.normalized)}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.clone(t)),new n(t.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(t){if(t===void 0){Cr("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:e,normalized:this.normalized}}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.toJSON(t)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):Zh(t,this.data.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Jh(t,this.data.array)}},hh=new F,oy=new F,ly=new Lt,En=class{constructor(t=new F(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,i,s){return this.normal.set(t,e,i),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,i){let s=hh.subVectors(i,e).cross(oy.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,i=!0){let s=t.delta(hh),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let a=-(t.start.dot(this.normal)+this.constant)/r;return i===!0&&(a<0||a>1)?null:e.copy(t.start).addScaledVector(s,a)}intersectsLine(t){let e=this.distanceToPoint(t.start),i=this.distanceToPoint(t.end);return e<0&&i>0||i<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let i=e||ly.getNormalMatrix(t),s=this.coplanarPoint(hh).applyMatrix4(t),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},cy=0,Si=class extends zn{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:cy++}),this.uuid=Pi(),this.name="",this.type="Material",this.blending=Ys,this.side=Ri,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Ah,this.blendDst=Th,this.blendEquation=Qi,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Yt(0,0,0),this.blendAlpha=0,this.depthFunc=ks,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=hm,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=_o,this.stencilZFail=_o,this.stencilZPass=_o,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let i=t[e];if(i===void 0){Rt(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Rt(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(t).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(t).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(t).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(t).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(t).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let a=[];for(let o in r){let l=r[o];delete l.metadata,a.push(l)}return a}if(e){let r=s(t.textures),a=s(t.images);r.length>0&&(i.textures=r),a.length>0&&(i.images=a)}return i}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Yt().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(i=>new En().fromJSON(i))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let i=t.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new $t().fromArray(i)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new $t().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,i=null;if(e!==null){let s=e.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=e[r].clone()}return this.clippingPlanes=i,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var ei=new F,uh=new F,to=new F,eo=new F,Nr=class{constructor(t=new F,e=new F(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,ei)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let i=e.dot(this.direction);return i<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=ei.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(ei.copy(this.origin).addScaledVector(this.direction,e),ei.distanceToSquared(t))}distanceSqToSegment(t,e,i,s){uh.copy(t).add(e).multiplyScalar(.5),to.copy(e).sub(t).normalize(),eo.copy(this.origin).sub(uh);let r=t.distanceTo(e)*.5,a=-this.direction.dot(to),o=eo.dot(this.direction),l=-eo.dot(to),c=eo.lengthSq(),h=Math.abs(1-a*a),f,u,d,m;if(h>0)if(f=a*l-o,u=a*o-l,m=r*h,f>=0)if(u>=-m)if(u<=m){let _=1/h;f*=_,u*=_,d=f*(f+a*u+2*o)+u*(a*f+u+2*l)+c}else u=r,f=Math.max(0,-(a*u+o)),d=-f*f+u*(u+2*l)+c;else u=-r,f=Math.max(0,-(a*u+o)),d=-f*f+u*(u+2*l)+c;else u<=-m?(f=Math.max(0,-(-a*r+o)),u=f>0?-r:Math.min(Math.max(-r,-l),r),d=-f*f+u*(u+2*l)+c):u<=m?(f=0,u=Math.min(Math.max(-r,-l),r),d=u*(u+2*l)+c):(f=Math.max(0,-(a*r+o)),u=f>0?r:Math.min(Math.max(-r,-l),r),d=-f*f+u*(u+2*l)+c);else u=a>0?-r:r,f=Math.max(0,-(a*u+o)),d=-f*f+u*(u+2*l)+c;return i&&i.copy(this.origin).addScaledVector(this.direction,f),s&&s.copy(uh).addScaledVector(to,u),d}intersectSphere(t,e){if(t.radius<0)return null;ei.subVectors(t.center,this.origin);let i=ei.dot(this.direction),s=ei.dot(ei)-i*i,r=t.radius*t.radius;if(s>r)return null;let a=Math.sqrt(r-s),o=i-a,l=i+a;return l<0?null:o<0?this.at(l,e):this.at(o,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(t.normal)+t.constant)/e;return i>=0?i:null}intersectPlane(t,e){let i=this.distanceToPlane(t);return i===null?null:this.at(i,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let i,s,r,a,o,l,c=1/this.direction.x,h=1/this.direction.y,f=1/this.direction.z,u=this.origin;return c>=0?(i=(t.min.x-u.x)*c,s=(t.max.x-u.x)*c):(i=(t.max.x-u.x)*c,s=(t.min.x-u.x)*c),h>=0?(r=(t.min.y-u.y)*h,a=(t.max.y-u.y)*h):(r=(t.max.y-u.y)*h,a=(t.min.y-u.y)*h),i>a||r>s||((r>i||isNaN(i))&&(i=r),(a<s||isNaN(s))&&(s=a),f>=0?(o=(t.min.z-u.z)*f,l=(t.max.z-u.z)*f):(o=(t.max.z-u.z)*f,l=(t.min.z-u.z)*f),i>l||o>s)||((o>i||i!==i)&&(i=o),(l<s||s!==s)&&(s=l),s<0)?null:this.at(i>=0?i:s,e)}intersectsBox(t){return this.intersectBox(t,ei)!==null}intersectTriangle(t,e,i,s,r){let a=this.origin,o=this.direction,l=o.x,c=o.y,h=o.z,f=t.x-a.x,u=t.y-a.y,d=t.z-a.z,m=e.x-a.x,_=e.y-a.y,p=e.z-a.z,g=i.x-a.x,M=i.y-a.y,A=i.z-a.z,b=Math.abs(l),E=Math.abs(c),S=Math.abs(h),x,w,O,P,D,N,V,I,W,Y,G,tt;if(b>=E&&b>=S?(O=l,N=f,W=m,tt=g,l>=0?(x=c,w=h,P=u,D=d,V=_,I=p,Y=M,G=A):(x=h,w=c,P=d,D=u,V=p,I=_,Y=A,G=M)):E>=S?(O=c,N=u,W=_,tt=M,c>=0?(x=h,w=l,P=d,D=f,V=p,I=m,Y=A,G=g):(x=l,w=h,P=f,D=d,V=m,I=p,Y=g,G=A)):(O=h,N=d,W=p,tt=A,h>=0?(x=l,w=c,P=f,D=u,V=m,I=_,Y=g,G=M):(x=c,w=l,P=u,D=f,V=_,I=m,Y=M,G=g)),O===0)return null;let X=x/O,j=w/O,et=1/O,Mt=P-X*N,Dt=D-j*N,J=V-X*W,mt=I-j*W,yt=Y-X*tt,Et=G-j*tt,gt=yt*mt-Et*J,Ft=Mt*Et-Dt*yt,me=J*Dt-mt*Mt;if(s){if(gt<0||Ft<0||me<0)return null}else if((gt<0||Ft<0||me<0)&&(gt>0||Ft>0||me>0))return null;let It=gt+Ft+me;if(It===0)return null;let Qt=et*(gt*N+Ft*W+me*tt);return(It>0?Qt<0:Qt>0)?null:this.at(Qt/It,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},No=class extends Si{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Yt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new bi,this.combine=Eh,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},Ap=new ie,qi=new Nr,no=new an,Tp=new F,io=new F,so=new F,ro=new F,fh=new F,ao=new F,Ep=new F,oo=new F,de=class extends sn{constructor(t=new ve,e=new No){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,a=s.length;r<a;r++){let o=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[o]=r}}}}getVertexPosition(t,e){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,a=i.morphTargetsRelative;e.fromBufferAttribute(s,t);let o=this.morphTargetInfluences;if(r&&o){ao.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=o[l],f=r[l];h!==0&&(fh.fromBufferAttribute(f,t),a?ao.addScaledVector(fh,h):ao.addScaledVector(fh.sub(e),h))}e.add(ao)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),no.copy(i.boundingSphere),no.applyMatrix4(r),qi.copy(t.ray).recast(t.near),!(no.containsPoint(qi.origin)===!1&&(qi.intersectSphere(no,Tp)===null||qi.origin.distanceToSquared(Tp)>(t.far-t.near)**2))&&(Ap.copy(r).invert(),qi.copy(t.ray).applyMatrix4(Ap),!(i.boundingBox!==null&&qi.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(t,e,qi)))}_computeIntersections(t,e,i){let s,r=this.geometry,a=this.material,o=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,f=r.attributes.normal,u=r.groups,d=r.drawRange;if(o!==null)if(Array.isArray(a))for(let m=0,_=u.length;m<_;m++){let p=u[m],g=a[p.materialIndex],M=Math.max(p.start,d.start),A=Math.min(o.count,Math.min(p.start+p.count,d.start+d.count));for(let b=M,E=A;b<E;b+=3){let S=o.getX(b),x=o.getX(b+1),w=o.getX(b+2);s=lo(this,g,t,i,c,h,f,S,x,w),s&&(s.faceIndex=Math.floor(b/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let m=Math.max(0,d.start),_=Math.min(o.count,d.start+d.count);for(let p=m,g=_;p<g;p+=3){let M=o.getX(p),A=o.getX(p+1),b=o.getX(p+2);s=lo(this,a,t,i,c,h,f,M,A,b),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(a))for(let m=0,_=u.length;m<_;m++){let p=u[m],g=a[p.materialIndex],M=Math.max(p.start,d.start),A=Math.min(l.count,Math.min(p.start+p.count,d.start+d.count));for(let b=M,E=A;b<E;b+=3){let S=b,x=b+1,w=b+2;s=lo(this,g,t,i,c,h,f,S,x,w),s&&(s.faceIndex=Math.floor(b/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let m=Math.max(0,d.start),_=Math.min(l.count,d.start+d.count);for(let p=m,g=_;p<g;p+=3){let M=p,A=p+1,b=p+2;s=lo(this,a,t,i,c,h,f,M,A,b),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}}};function hy(n,t,e,i,s,r,a,o){let l;if(t.side===qe?l=i.intersectTriangle(a,r,s,!0,o):l=i.intersectTriangle(s,r,a,t.side===Ri,o),l===null)return null;oo.copy(o),oo.applyMatrix4(n.matrixWorld);let c=e.ray.origin.distanceTo(oo);return c<e.near||c>e.far?null:{distance:c,point:oo.clone(),object:n}}function lo(n,t,e,i,s,r,a,o,l,c){n.getVertexPosition(o,io),n.getVertexPosition(l,so),n.getVertexPosition(c,ro);let h=hy(n,t,e,i,io,so,ro,Ep);if(h){let f=new F;vi.getBarycoord(Ep,io,so,ro,f),s&&(h.uv=vi.getInterpolatedAttribute(s,o,l,c,f,new $t)),r&&(h.uv1=vi.getInterpolatedAttribute(r,o,l,c,f,new $t)),a&&(h.normal=vi.getInterpolatedAttribute(a,o,l,c,f,new F),h.normal.dot(i.direction)>0&&h.normal.multiplyScalar(-1));let u={a:o,b:l,c,normal:new F,materialIndex:0};vi.getNormal(io,so,ro,u.normal),h.face=u,h.barycoord=f}return h}var Ws=class extends Qe{constructor(t=null,e=1,i=1,s,r,a,o,l,c=ue,h=ue,f,u){super(null,a,o,l,c,h,s,r,f,u),this.isDataTexture=!0,this.image={data:t,width:e,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var $i=new an,uy=new $t(.5,.5),co=new F,Ji=class{constructor(t=new En,e=new En,i=new En,s=new En,r=new En,a=new En){this.planes=[t,e,i,s,r,a]}set(t,e,i,s,r,a){let o=this.planes;return o[0].copy(t),o[1].copy(e),o[2].copy(i),o[3].copy(s),o[4].copy(r),o[5].copy(a),this}copy(t){let e=this.planes;for(let i=0;i<6;i++)e[i].copy(t.planes[i]);return this}setFromProjectionMatrix(t,e=_n,i=!1){let s=this.planes,r=t.elements,a=r[0],o=r[1],l=r[2],c=r[3],h=r[4],f=r[5],u=r[6],d=r[7],m=r[8],_=r[9],p=r[10],g=r[11],M=r[12],A=r[13],b=r[14],E=r[15];if(s[0].setComponents(c-a,d-h,g-m,E-M).normalize(),s[1].setComponents(c+a,d+h,g+m,E+M).normalize(),s[2].setComponents(c+o,d+f,g+_,E+A).normalize(),s[3].setComponents(c-o,d-f,g-_,E-A).normalize(),i)s[4].setComponents(l,u,p,b).normalize(),s[5].setComponents(c-l,d-u,g-p,E-b).normalize();else if(s[4].setComponents(c-l,d-u,g-p,E-b).normalize(),e===_n)s[5].setComponents(c+l,d+u,g+p,E+b).normalize();else if(e===Tr)s[5].setComponents(l,u,p,b).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),$i.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),$i.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere($i)}intersectsSprite(t){$i.center.set(0,0,0);let e=uy.distanceTo(t.center);return $i.radius=.7071067811865476+e,$i.applyMatrix4(t.matrixWorld),this.intersectsSphere($i)}intersectsSphere(t){let e=this.planes,i=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let i=0;i<6;i++){let s=e[i];if(co.x=s.normal.x>0?t.max.x:t.min.x,co.y=s.normal.y>0?t.max.y:t.min.y,co.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(co)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let i=0;i<6;i++)if(e[i].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Cp=new ie,Do=class n{constructor(){this.coordinateSystem=_n,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,i=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];Cp.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new Ji),i[s].setFromProjectionMatrix(Cp,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,i=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new Ji),e[s].copy(i[s]);return this._count=t._count,this}clone(){return new n().copy(this)}};var Uo=class extends Si{constructor(t){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new Yt(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}},Rp=new ie,_h=new Nr,ho=new an,uo=new F,Ki=class extends sn{constructor(t=new ve,e=new Uo){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.matrixWorld,r=t.params.Points.threshold,a=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),ho.copy(i.boundingSphere),ho.applyMatrix4(s),ho.radius+=r,t.ray.intersectsSphere(ho)===!1)return;Rp.copy(s).invert(),_h.copy(t.ray).applyMatrix4(Rp);let o=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=o*o,c=i.index,f=i.attributes.position;if(c!==null){let u=Math.max(0,a.start),d=Math.min(c.count,a.start+a.count);for(let m=u,_=d;m<_;m++){let p=c.getX(m);uo.fromBufferAttribute(f,p),Ip(uo,p,l,s,t,e,this)}}else{let u=Math.max(0,a.start),d=Math.min(f.count,a.start+a.count);for(let m=u,_=d;m<_;m++)uo.fromBufferAttribute(f,m),Ip(uo,m,l,s,t,e,this)}}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,a=s.length;r<a;r++){let o=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[o]=r}}}}};function Ip(n,t,e,i,s,r,a){let o=_h.distanceSqToPoint(n);if(o<e){let l=new F;_h.closestPointToPoint(n,l),l.applyMatrix4(i);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(o),point:l,index:t,face:null,faceIndex:null,barycoord:null,object:a})}}var Dr=class extends Qe{constructor(t=[],e=ts,i,s,r,a,o,l,c,h){super(t,e,i,s,r,a,o,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var on=class extends Qe{constructor(t,e,i=Ye,s,r,a,o=ue,l=ue,c,h=ii,f=1){if(h!==ii&&h!==ri)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let u={width:t,height:e,depth:f};super(u,s,r,a,o,l,h,i,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new Gs(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},Ur=class extends on{constructor(t,e=Ye,i=ts,s,r,a=ue,o=ue,l,c=ii){let h={width:t,height:t,depth:1},f=[h,h,h,h,h,h];super(t,t,e,i,s,r,a,o,l,c),this.image=f,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},Fr=class extends Qe{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},Xs=class n extends ve{constructor(t=1,e=1,i=1,s=1,r=1,a=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:i,widthSegments:s,heightSegments:r,depthSegments:a};let o=this;s=Math.floor(s),r=Math.floor(r),a=Math.floor(a);let l=[],c=[],h=[],f=[],u=0,d=0;m("z","y","x",-1,-1,i,e,t,a,r,0),m("z","y","x",1,-1,i,e,-t,a,r,1),m("x","z","y",1,1,t,i,e,s,a,2),m("x","z","y",1,-1,t,i,-e,s,a,3),m("x","y","z",1,-1,t,e,i,s,r,4),m("x","y","z",-1,-1,t,e,-i,s,r,5),this.setIndex(l),this.setAttribute("position",new ke(c,3)),this.setAttribute("normal",new ke(h,3)),this.setAttribute("uv",new ke(f,2));function m(_,p,g,M,A,b,E,S,x,w,O){let P=b/x,D=E/w,N=b/2,V=E/2,I=S/2,W=x+1,Y=w+1,G=0,tt=0,X=new F;for(let j=0;j<Y;j++){let et=j*D-V;for(let Mt=0;Mt<W;Mt++){let Dt=Mt*P-N;X[_]=Dt*M,X[p]=et*A,X[g]=I,c.push(X.x,X.y,X.z),X[_]=0,X[p]=0,X[g]=S>0?1:-1,h.push(X.x,X.y,X.z),f.push(Mt/x),f.push(1-j/w),G+=1}}for(let j=0;j<w;j++)for(let et=0;et<x;et++){let Mt=u+et+W*j,Dt=u+et+W*(j+1),J=u+(et+1)+W*(j+1),mt=u+(et+1)+W*j;l.push(Mt,Dt,mt),l.push(Dt,J,mt),tt+=6}o.addGroup(d,tt,O),d+=tt,u+=G}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var Gn=class n extends ve{constructor(t=1,e=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:i,heightSegments:s};let r=t/2,a=e/2,o=Math.floor(i),l=Math.floor(s),c=o+1,h=l+1,f=t/o,u=e/l,d=[],m=[],_=[],p=[];for(let g=0;g<h;g++){let M=g*u-a;for(let A=0;A<c;A++){let b=A*f-r;m.push(b,-M,0),_.push(0,0,1),p.push(A/o),p.push(1-g/l)}}for(let g=0;g<l;g++)for(let M=0;M<o;M++){let A=M+c*g,b=M+c*(g+1),E=M+1+c*(g+1),S=M+1+c*g;d.push(A,b,S),d.push(b,E,S)}this.setIndex(d),this.setAttribute("position",new ke(m,3)),this.setAttribute("normal",new ke(_,3)),this.setAttribute("uv",new ke(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.width,t.height,t.widthSegments,t.heightSegments)}};var Or=class extends ve{constructor(t=null){if(super(),this.type="WireframeGeometry",this.parameters={geometry:t},t!==null){let e=[],i=new Set,s=new F,r=new F;if(t.index!==null){let a=t.attributes.position,o=t.index,l=t.groups;l.length===0&&(l=[{start:0,count:o.count,materialIndex:0}]);for(let c=0,h=l.length;c<h;++c){let f=l[c],u=f.start,d=f.count;for(let m=u,_=u+d;m<_;m+=3)for(let p=0;p<3;p++){let g=o.getX(m+p),M=o.getX(m+(p+1)%3);s.fromBufferAttribute(a,g),r.fromBufferAttribute(a,M),Pp(s,r,i)===!0&&(e.push(s.x,s.y,s.z),e.push(r.x,r.y,r.z))}}}else{let a=t.attributes.position;for(let o=0,l=a.count/3;o<l;o++)for(let c=0;c<3;c++){let h=3*o+c,f=3*o+(c+1)%3;s.fromBufferAttribute(a,h),r.fromBufferAttribute(a,f),Pp(s,r,i)===!0&&(e.push(s.x,s.y,s.z),e.push(r.x,r.y,r.z))}}this.setAttribute("position",new ke(e,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}};function Pp(n,t,e){let i=`${n.x},${n.y},${n.z}-${t.x},${t.y},${t.z}`,s=`${t.x},${t.y},${t.z}-${n.x},${n.y},${n.z}`;return e.has(i)===!0||e.has(s)===!0?!1:(e.add(i),e.add(s),!0)}function ns(n){let t={};for(let e in n){t[e]={};for(let i in n[e]){let s=n[e][i];if(Lp(s))s.isRenderTargetTexture?(Rt("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][i]=null):t[e][i]=s.clone();else if(Array.isArray(s))if(Lp(s[0])){let r=[];for(let a=0,o=s.length;a<o;a++)r[a]=s[a].clone();t[e][i]=r}else t[e][i]=s.slice();else t[e][i]=s}}return t}function ze(n){let t={};for(let e=0;e<n.length;e++){let i=ns(n[e]);for(let s in i)t[s]=i[s]}return t}function Lp(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function fy(n){let t=[];for(let e=0;e<n.length;e++)t.push(n[e].clone());return t}function jh(n){let t=n.getRenderTarget();return t===null?n.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:qt.workingColorSpace}var jr={clone:ns,merge:ze},dy=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,py=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,pe=class extends Si{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=dy,this.fragmentShader=py,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=ns(t.uniforms),this.uniformsGroups=fy(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let a=this.uniforms[s].value;a&&a.isTexture?e.uniforms[s]={type:"t",value:a.toJSON(t).uuid}:a&&a.isColor?e.uniforms[s]={type:"c",value:a.getHex()}:a&&a.isVector2?e.uniforms[s]={type:"v2",value:a.toArray()}:a&&a.isVector3?e.uniforms[s]={type:"v3",value:a.toArray()}:a&&a.isVector4?e.uniforms[s]={type:"v4",value:a.toArray()}:a&&a.isMatrix3?e.uniforms[s]={type:"m3",value:a.toArray()}:a&&a.isMatrix4?e.uniforms[s]={type:"m4",value:a.toArray()}:e.uniforms[s]={value:a}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(e.extensions=i),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let i in t.uniforms){let s=t.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=e[s.value]||null;break;case"c":this.uniforms[i].value=new Yt().setHex(s.value);break;case"v2":this.uniforms[i].value=new $t().fromArray(s.value);break;case"v3":this.uniforms[i].value=new F().fromArray(s.value);break;case"v4":this.uniforms[i].value=new Kt().fromArray(s.value);break;case"m3":this.uniforms[i].value=new Lt().fromArray(s.value);break;case"m4":this.uniforms[i].value=new ie().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let i in t.extensions)this.extensions[i]=t.extensions[i];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},Fo=class extends pe{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Oo=class extends Si{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=lm,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},Bo=class extends Si{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function Ns(n,t){return!n||n.constructor===t?n:typeof t.BYTES_PER_ELEMENT=="number"?new t(n):Array.prototype.slice.call(n)}function fo(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var wi=class{constructor(t,e,i,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(i),this.sampleValues=e,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,i=this._cachedIndex,s=e[i],r=e[i-1];t:{e:{let a;n:{i:if(!(t<s)){for(let o=i+2;;){if(s===void 0){if(t<r)break i;return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===o)break;if(r=s,s=e[++i],t<s)break e}a=e.length;break n}if(!(t>=r)){let o=e[1];t<o&&(i=2,r=o);for(let l=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===l)break;if(s=r,r=e[--i-1],t>=r)break e}a=i,i=0;break n}break t}for(;i<a;){let o=i+a>>>1;t<e[o]?a=o:i=o+1}if(s=e[i],r=e[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=t*s;for(let a=0;a!==s;++a)e[a]=i[r+a];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},ko=class extends wi{constructor(t,e,i,s){super(t,e,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:mh,endingEnd:mh}}intervalChanged_(t,e,i){let s=this.parameterPositions,r=t-2,a=t+1,o=s[r],l=s[a];if(o===void 0)switch(this.getSettings_().endingStart){case gh:r=t,o=2*e-i;break;case xh:r=s.length-2,o=e+s[r]-s[r+1];break;default:r=t,o=i}if(l===void 0)switch(this.getSettings_().endingEnd){case gh:a=t,l=2*i-e;break;case xh:a=1,l=i+s[1]-s[0];break;default:a=t-1,l=e}let c=(i-e)*.5,h=this.valueSize;this._weightPrev=c/(e-o),this._weightNext=c/(l-i),this._offsetPrev=r*h,this._offsetNext=a*h}interpolate_(t,e,i,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=t*o,c=l-o,h=this._offsetPrev,f=this._offsetNext,u=this._weightPrev,d=this._weightNext,m=(i-e)/(s-e),_=m*m,p=_*m,g=-u*p+2*u*_-u*m,M=(1+u)*p+(-1.5-2*u)*_+(-.5+u)*m+1,A=(-1-d)*p+(1.5+d)*_+.5*m,b=d*p-d*_;for(let E=0;E!==o;++E)r[E]=g*a[h+E]+M*a[c+E]+A*a[l+E]+b*a[f+E];return r}},zo=class extends wi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t,e,i,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=t*o,c=l-o,h=(i-e)/(s-e),f=1-h;for(let u=0;u!==o;++u)r[u]=a[c+u]*f+a[l+u]*h;return r}},Vo=class extends wi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t){return this.copySampleValue_(t-1)}},Go=class extends wi{interpolate_(t,e,i,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=t*o,c=l-o,h=this.inTangents,f=this.outTangents;if(!h||!f){let m=(i-e)/(s-e),_=1-m;for(let p=0;p!==o;++p)r[p]=a[c+p]*_+a[l+p]*m;return r}let u=o*2,d=t-1;for(let m=0;m!==o;++m){let _=a[c+m],p=a[l+m],g=d*u+m*2,M=f[g],A=f[g+1],b=t*u+m*2,E=h[b],S=h[b+1],x=gy(i,e,M,E,s);r[m]=bm(x,_,A,S,p)}return r}};function bm(n,t,e,i,s){let r=1-n;return r*r*r*t+3*r*r*n*e+3*r*n*n*i+n*n*n*s}function my(n,t,e,i,s){let r=1-n;return 3*r*r*(e-t)+6*r*n*(i-e)+3*n*n*(s-i)}function gy(n,t,e,i,s){let r=(n-t)/(s-t);for(let a=0;a<8;a++){let o=bm(r,t,e,i,s)-n;if(Math.abs(o)<1e-10)break;let l=my(r,t,e,i,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-o/l))}return r}var ln=class{constructor(t,e,i,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=Ns(e,this.TimeBufferType),this.values=Ns(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,i;if(e.toJSON!==this.toJSON)i=e.toJSON(t);else{i={name:t.name,times:Ns(t.times,Array),values:Ns(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(i.interpolation=s),fo(t.settings)&&(i.settings={inTangents:Ns(t.settings.inTangents,Array),outTangents:Ns(t.settings.outTangents,Array)})}return i.type=t.ValueTypeName,i}InterpolantFactoryMethodDiscrete(t){return new Vo(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new zo(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new ko(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new Go(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case wr:e=this.InterpolantFactoryMethodDiscrete;break;case Co:e=this.InterpolantFactoryMethodLinear;break;case xo:e=this.InterpolantFactoryMethodSmooth;break;case ph:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return Rt("KeyframeTrack:",i),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return wr;case this.InterpolantFactoryMethodLinear:return Co;case this.InterpolantFactoryMethodSmooth:return xo;case this.InterpolantFactoryMethodBezier:return ph}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let i=0,s=e.length;i!==s;++i)e[i]+=t;fo(this.settings)&&(Np(this.settings.inTangents,t),Np(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let i=0,s=e.length;i!==s;++i)e[i]*=t;fo(this.settings)&&(Dp(this.settings.inTangents,t),Dp(this.settings.outTangents,t))}return this}trim(t,e){let i=this.times,s=i.length,r=0,a=s-1;for(;r!==s&&i[r]<t;)++r;for(;a!==-1&&i[a]>e;)--a;if(++a,r!==0||a!==s){r>=a&&(a=Math.max(a,1),r=a-1);let o=this.getValueSize();this.times=i.slice(r,a),this.values=this.values.slice(r*o,a*o)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Pt("KeyframeTrack: Invalid value size in track.",this),t=!1);let i=this.times,s=this.values,r=i.length;r===0&&(Pt("KeyframeTrack: Track is empty.",this),t=!1);let a=null;for(let o=0;o!==r;o++){let l=i[o];if(typeof l=="number"&&isNaN(l)){Pt("KeyframeTrack: Time is not a valid number.",this,o,l),t=!1;break}if(a!==null&&a>l){Pt("KeyframeTrack: Out of order keys.",this,o,l,a),t=!1;break}a=l}if(s!==void 0&&L_(s))for(let o=0,l=s.length;o!==l;++o){let c=s[o];if(isNaN(c)){Pt("KeyframeTrack: Value is not a valid number.",this,o,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===xo,r=t.length-1,a=1;for(let o=1;o<r;++o){let l=!1,c=t[o],h=t[o+1];if(c!==h&&(o!==1||c!==t[0]))if(s)l=!0;else{let f=o*i,u=f-i,d=f+i;for(let m=0;m!==i;++m){let _=e[f+m];if(_!==e[u+m]||_!==e[d+m]){l=!0;break}}}if(l){if(o!==a){t[a]=t[o];let f=o*i,u=a*i;for(let d=0;d!==i;++d)e[u+d]=e[f+d]}++a}}if(r>0){t[a]=t[r];for(let o=r*i,l=a*i,c=0;c!==i;++c)e[l+c]=e[o+c];++a}return a!==t.length?(this.times=t.slice(0,a),this.values=e.slice(0,a*i)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),i=this.constructor,s=new i(this.name,t,e);return s.createInterpolant=this.createInterpolant,fo(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function Np(n,t){for(let e=0,i=n.length;e!==i;e+=2)n[e]+=t}function Dp(n,t){for(let e=0,i=n.length;e!==i;e+=2)n[e]*=t}ln.prototype.ValueTypeName="";ln.prototype.TimeBufferType=Float32Array;ln.prototype.ValueBufferType=Float32Array;ln.prototype.DefaultInterpolation=Co;var Ai=class extends ln{constructor(t,e,i){super(t,e,i)}};Ai.prototype.ValueTypeName="bool";Ai.prototype.ValueBufferType=Array;Ai.prototype.DefaultInterpolation=wr;Ai.prototype.InterpolantFactoryMethodLinear=void 0;Ai.prototype.InterpolantFactoryMethodSmooth=void 0;var Ho=class extends ln{constructor(t,e,i,s){super(t,e,i,s)}};Ho.prototype.ValueTypeName="color";var Wo=class extends ln{constructor(t,e,i,s){super(t,e,i,s)}};Wo.prototype.ValueTypeName="number";var Xo=class extends wi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t,e,i,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=(i-e)/(s-e),c=t*o;for(let h=c+o;c!==h;c+=4)Vn.slerpFlat(r,0,a,c-o,a,c,l);return r}},Br=class extends ln{constructor(t,e,i,s){super(t,e,i,s)}InterpolantFactoryMethodLinear(t){return new Xo(this.times,this.values,this.getValueSize(),t)}};Br.prototype.ValueTypeName="quaternion";Br.prototype.InterpolantFactoryMethodSmooth=void 0;var Ti=class extends ln{constructor(t,e,i){super(t,e,i)}};Ti.prototype.ValueTypeName="string";Ti.prototype.ValueBufferType=Array;Ti.prototype.DefaultInterpolation=wr;Ti.prototype.InterpolantFactoryMethodLinear=void 0;Ti.prototype.InterpolantFactoryMethodSmooth=void 0;var qo=class extends ln{constructor(t,e,i,s){super(t,e,i,s)}};qo.prototype.ValueTypeName="vector";var $o=class{constructor(t,e,i){let s=this,r=!1,a=0,o=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=i,this._abortController=null,this.itemStart=function(h){o++,r===!1&&s.onStart!==void 0&&s.onStart(h,a,o),r=!0},this.itemEnd=function(h){a++,s.onProgress!==void 0&&s.onProgress(h,a,o),a===o&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,f){return c.push(h,f),this},this.removeHandler=function(h){let f=c.indexOf(h);return f!==-1&&c.splice(f,2),this},this.getHandler=function(h){for(let f=0,u=c.length;f<u;f+=2){let d=c[f],m=c[f+1];if(d.global&&(d.lastIndex=0),d.test(h))return m}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},Mm=new $o,Yo=class{constructor(t){this.manager=t!==void 0?t:Mm,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let i=this;return new Promise(function(s,r){i.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};Yo.DEFAULT_MATERIAL_NAME="__DEFAULT";var po=new F,mo=new Vn,Bn=new F,kr=class extends sn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new ie,this.projectionMatrix=new ie,this.projectionMatrixInverse=new ie,this.coordinateSystem=_n,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(po,mo,Bn),Bn.x===1&&Bn.y===1&&Bn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(po,mo,Bn.set(1,1,1)).invert()}updateWorldMatrix(t,e,i=!1){super.updateWorldMatrix(t,e,i),this.matrixWorld.decompose(po,mo,Bn),Bn.x===1&&Bn.y===1&&Bn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(po,mo,Bn.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},yi=new F,Up=new $t,Fp=new $t,Xe=class extends kr{constructor(t=50,e=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=Vs*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(Mr*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return Vs*2*Math.atan(Math.tan(Mr*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,i){yi.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(yi.x,yi.y).multiplyScalar(-t/yi.z),yi.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(yi.x,yi.y).multiplyScalar(-t/yi.z)}getViewSize(t,e){return this.getViewBounds(t,Up,Fp),e.subVectors(Fp,Up)}setViewOffset(t,e,i,s,r,a){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=a,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(Mr*.5*this.fov)/this.zoom,i=2*e,s=this.aspect*i,r=-.5*s,a=this.view;if(this.view!==null&&this.view.enabled){let l=a.fullWidth,c=a.fullHeight;r+=a.offsetX*s/l,e-=a.offsetY*i/c,s*=a.width/l,i*=a.height/c}let o=this.filmOffset;o!==0&&(r+=t*o/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-i,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var Ei=class extends kr{constructor(t=-1,e=1,i=1,s=-1,r=.1,a=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=i,this.bottom=s,this.near=r,this.far=a,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,i,s,r,a){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=a,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-t,a=i+t,o=s+e,l=s-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,a=r+c*this.view.width,o-=h*this.view.offsetY,l=o-h*this.view.height}this.projectionMatrix.makeOrthographic(r,a,o,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}};var zr=class extends ve{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(t){return super.copy(t),this.instanceCount=t.instanceCount,this}toJSON(){let t=super.toJSON();return t.instanceCount=this.instanceCount,t.isInstancedBufferGeometry=!0,t}};var Ds=-90,Us=1,qs=class extends sn{constructor(t,e,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new Xe(Ds,Us,t,e);s.layers=this.layers,this.add(s);let r=new Xe(Ds,Us,t,e);r.layers=this.layers,this.add(r);let a=new Xe(Ds,Us,t,e);a.layers=this.layers,this.add(a);let o=new Xe(Ds,Us,t,e);o.layers=this.layers,this.add(o);let l=new Xe(Ds,Us,t,e);l.layers=this.layers,this.add(l);let c=new Xe(Ds,Us,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[i,s,r,a,o,l]=e;for(let c of e)this.remove(c);if(t===_n)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),a.up.set(0,0,1),a.lookAt(0,-1,0),o.up.set(0,1,0),o.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===Tr)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),a.up.set(0,0,-1),a.lookAt(0,-1,0),o.up.set(0,-1,0),o.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,a,o,l,c,h]=this.children,f=t.getRenderTarget(),u=t.getActiveCubeFace(),d=t.getActiveMipmapLevel(),m=t.xr.enabled;t.xr.enabled=!1;let _=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let p=!1;t.isWebGLRenderer===!0?p=t.state.buffers.depth.getReversed():p=t.reversedDepthBuffer,t.setRenderTarget(i,0,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(i,1,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(i,2,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(i,3,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(i,4,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),i.texture.mipmapsAutoUpdate=_,t.setRenderTarget(i,5,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(f,u,d),t.xr.enabled=m,i.texture.needsPMREMUpdate=!0}},Zo=class extends Xe{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var Qh="\\[\\]\\.:\\/",xy=new RegExp("["+Qh+"]","g"),tu="[^"+Qh+"]",_y="[^"+Qh.replace("\\.","")+"]",yy=/((?:WC+[\/:])*)/.source.replace("WC",tu),vy=/(WCOD+)?/.source.replace("WCOD",_y),by=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",tu),My=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",tu),Sy=new RegExp("^"+yy+vy+by+My+"$"),wy=["material","materials","bones","map"],yh=class{constructor(t,e,i){let s=i||ae.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(t,e)}setValue(t,e){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].unbind()}},ae=class n{constructor(t,e,i){this.path=e,this.parsedPath=i||n.parseTrackName(e),this.node=n.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,i){return t&&t.isAnimationObjectGroup?new n.Composite(t,e,i):new n(t,e,i)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(xy,"")}static parseTrackName(t){let e=Sy.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let i={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);wy.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return i}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let i=t.skeleton.getBoneByName(e);if(i!==void 0)return i}if(t.children){let i=function(r){for(let a=0;a<r.length;a++){let o=r[a];if(o.name===e||o.uuid===e)return o;let l=i(o.children);if(l)return l}return null},s=i(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)t[e++]=i[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,i=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=n.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){Rt("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let c=e.objectIndex;switch(i){case"materials":if(!t.material){Pt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Pt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Pt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===c){c=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Pt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Pt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[i]===void 0){Pt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[i]}if(c!==void 0){if(t[c]===void 0){Pt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let a=t[s];if(a===void 0){let c=e.nodeName;Pt("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",t);return}let o=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?o=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(o=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){Pt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Pt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=a,this.propertyIndex=r}else a.fromArray!==void 0&&a.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=a):Array.isArray(a)?(l=this.BindingType.EntireArray,this.resolvedProperty=a):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][o]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};ae.Composite=yh;ae.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};ae.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};ae.prototype.GetterByBindingType=[ae.prototype._getValue_direct,ae.prototype._getValue_array,ae.prototype._getValue_arrayElement,ae.prototype._getValue_toArray];ae.prototype.SetterByBindingTypeAndVersioning=[[ae.prototype._setValue_direct,ae.prototype._setValue_direct_setNeedsUpdate,ae.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[ae.prototype._setValue_array,ae.prototype._setValue_array_setNeedsUpdate,ae.prototype._setValue_array_setMatrixWorldNeedsUpdate],[ae.prototype._setValue_arrayElement,ae.prototype._setValue_arrayElement_setNeedsUpdate,ae.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[ae.prototype._setValue_fromArray,ae.prototype._setValue_fromArray_setNeedsUpdate,ae.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var pE=new Float32Array(1);var Ci=class extends Lo{constructor(t,e,i=1){super(t,e),this.isInstancedInterleavedBuffer=!0,this.meshPerAttribute=i}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}clone(t){let e=super.clone(t);return e.meshPerAttribute=this.meshPerAttribute,e}toJSON(t){let e=super.toJSON(t);return e.isInstancedInterleavedBuffer=!0,e.meshPerAttribute=this.meshPerAttribute,e}};var vh=class{static{this.prototype.isMatrix2=!0}constructor(t,e,i,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let i=0;i<4;i++)this.elements[i]=t[i+e];return this}set(t,e,i,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=i,r[3]=s,this}};var Op=new F,go=new F,Fs=new F,Os=new F,dh=new F,Ay=new F,Ty=new F,Vr=class{constructor(t=new F,e=new F){this.start=t,this.end=e}set(t,e){return this.start.copy(t),this.end.copy(e),this}copy(t){return this.start.copy(t.start),this.end.copy(t.end),this}getCenter(t){return t.addVectors(this.start,this.end).multiplyScalar(.5)}delta(t){return t.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(t,e){return this.delta(e).multiplyScalar(t).add(this.start)}closestPointToPointParameter(t,e){Op.subVectors(t,this.start),go.subVectors(this.end,this.start);let i=go.dot(go);if(i===0)return 0;let r=go.dot(Op)/i;return e&&(r=Ot(r,0,1)),r}closestPointToPoint(t,e,i){let s=this.closestPointToPointParameter(t,e);return this.delta(i).multiplyScalar(s).add(this.start)}distanceSqToLine3(t,e=Ay,i=Ty){let s=10000000000000001e-32,r,a,o=this.start,l=t.start,c=this.end,h=t.end;Fs.subVectors(c,o),Os.subVectors(h,l),dh.subVectors(o,l);let f=Fs.dot(Fs),u=Os.dot(Os),d=Os.dot(dh);if(f<=s&&u<=s)return e.copy(o),i.copy(l),e.distanceToSquared(i);if(f<=s)r=0,a=d/u,a=Ot(a,0,1);else{let m=Fs.dot(dh);if(u<=s)a=0,r=Ot(-m/f,0,1);else{let _=Fs.dot(Os),p=f*u-_*_;p!==0?r=Ot((_*d-m*u)/p,0,1):r=0,a=(_*r+d)/u,a<0?(a=0,r=Ot(-m/f,0,1)):a>1&&(a=1,r=Ot((_-m)/f,0,1))}}return e.copy(o).addScaledVector(Fs,r),i.copy(l).addScaledVector(Os,a),e.distanceToSquared(i)}applyMatrix4(t){return this.start.applyMatrix4(t),this.end.applyMatrix4(t),this}equals(t){return t.start.equals(this.start)&&t.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};function eu(n,t,e,i){let s=Ey(i);switch(e){case zh:return n*t;case Gh:return n*t/s.components*s.byteLength;case nl:return n*t/s.components*s.byteLength;case Ii:return n*t*2/s.components*s.byteLength;case il:return n*t*2/s.components*s.byteLength;case Vh:return n*t*3/s.components*s.byteLength;case cn:return n*t*4/s.components*s.byteLength;case sl:return n*t*4/s.components*s.byteLength;case Wr:case Xr:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*8;case qr:case $r:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case al:case ll:return Math.max(n,16)*Math.max(t,8)/4;case rl:case ol:return Math.max(n,8)*Math.max(t,8)/2;case cl:case hl:case fl:case dl:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*8;case ul:case Yr:case pl:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case ml:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case gl:return Math.floor((n+4)/5)*Math.floor((t+3)/4)*16;case xl:return Math.floor((n+4)/5)*Math.floor((t+4)/5)*16;case _l:return Math.floor((n+5)/6)*Math.floor((t+4)/5)*16;case yl:return Math.floor((n+5)/6)*Math.floor((t+5)/6)*16;case vl:return Math.floor((n+7)/8)*Math.floor((t+4)/5)*16;case bl:return Math.floor((n+7)/8)*Math.floor((t+5)/6)*16;case Ml:return Math.floor((n+7)/8)*Math.floor((t+7)/8)*16;case Sl:return Math.floor((n+9)/10)*Math.floor((t+4)/5)*16;case wl:return Math.floor((n+9)/10)*Math.floor((t+5)/6)*16;case Al:return Math.floor((n+9)/10)*Math.floor((t+7)/8)*16;case Tl:return Math.floor((n+9)/10)*Math.floor((t+9)/10)*16;case El:return Math.floor((n+11)/12)*Math.floor((t+9)/10)*16;case Cl:return Math.floor((n+11)/12)*Math.floor((t+11)/12)*16;case Rl:case Il:case Pl:return Math.ceil(n/4)*Math.ceil(t/4)*16;case Ll:case Nl:return Math.ceil(n/4)*Math.ceil(t/4)*8;case Zr:case Dl:return Math.ceil(n/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function Ey(n){switch(n){case $e:case Fh:return{byteLength:1,components:1};case Js:case Oh:case In:return{byteLength:2,components:1};case tl:case el:return{byteLength:2,components:4};case Ye:case Qo:case Rn:return{byteLength:4,components:1};case Bh:case kh:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Rt("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function Wm(){let n=null,t=!1,e=null,i=null;function s(r,a){i=n.requestAnimationFrame(s),e(r,a)}return{start:function(){t!==!0&&e!==null&&n!==null&&(i=n.requestAnimationFrame(s),t=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){n=r}}}function Ry(n){let t=new WeakMap;function e(o,l){let c=o.array,h=o.usage,f=c.byteLength,u=n.createBuffer();n.bindBuffer(l,u),n.bufferData(l,c,h),o.onUploadCallback();let d;if(c instanceof Float32Array)d=n.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)d=n.HALF_FLOAT;else if(c instanceof Uint16Array)o.isFloat16BufferAttribute?d=n.HALF_FLOAT:d=n.UNSIGNED_SHORT;else if(c instanceof Int16Array)d=n.SHORT;else if(c instanceof Uint32Array)d=n.UNSIGNED_INT;else if(c instanceof Int32Array)d=n.INT;else if(c instanceof Int8Array)d=n.BYTE;else if(c instanceof Uint8Array)d=n.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)d=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:u,type:d,bytesPerElement:c.BYTES_PER_ELEMENT,version:o.version,size:f}}function i(o,l,c){let h=l.array,f=l.updateRanges;if(n.bindBuffer(c,o),f.length===0)n.bufferSubData(c,0,h);else{f.sort((d,m)=>d.start-m.start);let u=0;for(let d=1;d<f.length;d++){let m=f[u],_=f[d];_.start<=m.start+m.count+1?m.count=Math.max(m.count,_.start+_.count-m.start):(++u,f[u]=_)}f.length=u+1;for(let d=0,m=f.length;d<m;d++){let _=f[d];n.bufferSubData(c,_.start*h.BYTES_PER_ELEMENT,h,_.start,_.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(o){return o.isInterleavedBufferAttribute&&(o=o.data),t.get(o)}function r(o){o.isInterleavedBufferAttribute&&(o=o.data);let l=t.get(o);l&&(n.deleteBuffer(l.buffer),t.delete(o))}function a(o,l){if(o.isInterleavedBufferAttribute&&(o=o.data),o.isGLBufferAttribute){let h=t.get(o);(!h||h.version<o.version)&&t.set(o,{buffer:o.buffer,type:o.type,bytesPerElement:o.elementSize,version:o.version});return}let c=t.get(o);if(c===void 0)t.set(o,e(o,l));else if(c.version<o.version){if(c.size!==o.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(c.buffer,o,l),c.version=o.version}}return{get:s,remove:r,update:a}}var Iy=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,Py=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,Ly=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,Ny=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Dy=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,Uy=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,Fy=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,Oy=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,By=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,ky=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,zy=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,Vy=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,Gy=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,Hy=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,Wy=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,Xy=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,qy=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,$y=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Yy=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Zy=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,Jy=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,Ky=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,jy=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Qy=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,tv=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,ev=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,nv=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,iv=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,sv=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,rv="gl_FragColor = linearToOutputTexel( gl_FragColor );",av=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,ov=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,lv=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,cv=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,hv=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,uv=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,fv=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,dv=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,pv=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,mv=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,gv=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,xv=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,_v=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,yv=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,vv=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,bv=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,Mv=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,Sv=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,wv=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,Av=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,Tv=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,Ev=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,Cv=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,Rv=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,Iv=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,Pv=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,Lv=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,Nv=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,Dv=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,Uv=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,Fv=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,Ov=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,Bv=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,kv=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,zv=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,Vv=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,Gv=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,Hv=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,Wv=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Xv=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,qv=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,$v=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,Yv=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,Zv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Jv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Kv=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,jv=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,Qv=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,tb=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,eb=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,nb=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,ib=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,sb=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,rb=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,ab=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,ob=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,lb=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,cb=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,hb=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,ub=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,fb=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,db=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,pb=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,mb=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,gb=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,xb=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,_b=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,yb=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,vb=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,bb=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,Mb=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,Sb=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,wb=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,Ab=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,Tb=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,Eb=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,Cb=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,Rb=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,Ib=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Pb=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,Lb=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Nb=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,Db=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Ub=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,Fb=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,Ob=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,Bb=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,kb=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,zb=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Vb=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Gb=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Hb=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,Wb=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Xb=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,qb=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,$b=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,Yb=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Zb=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,Jb=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,Kb=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,jb=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Qb=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,tM=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,eM=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,nM=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,iM=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,sM=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,rM=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,aM=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,oM=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,lM=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,zt={alphahash_fragment:Iy,alphahash_pars_fragment:Py,alphamap_fragment:Ly,alphamap_pars_fragment:Ny,alphatest_fragment:Dy,alphatest_pars_fragment:Uy,aomap_fragment:Fy,aomap_pars_fragment:Oy,batching_pars_vertex:By,batching_vertex:ky,begin_vertex:zy,beginnormal_vertex:Vy,bsdfs:Gy,iridescence_fragment:Hy,bumpmap_pars_fragment:Wy,clipping_planes_fragment:Xy,clipping_planes_pars_fragment:qy,clipping_planes_pars_vertex:$y,clipping_planes_vertex:Yy,color_fragment:Zy,color_pars_fragment:Jy,color_pars_vertex:Ky,color_vertex:jy,common:Qy,defaultnormal_vertex:tv,displacementmap_pars_vertex:ev,displacementmap_vertex:nv,emissivemap_fragment:iv,emissivemap_pars_fragment:sv,colorspace_fragment:rv,colorspace_pars_fragment:av,envmap_fragment:ov,envmap_common_pars_fragment:lv,envmap_pars_fragment:cv,envmap_pars_vertex:hv,envmap_physical_pars_fragment:bv,envmap_vertex:uv,fog_vertex:fv,fog_pars_vertex:dv,fog_fragment:pv,fog_pars_fragment:mv,gradientmap_pars_fragment:gv,lightmap_pars_fragment:xv,lights_lambert_fragment:_v,lights_lambert_pars_fragment:yv,lights_pars_begin:vv,lights_toon_fragment:Mv,lights_toon_pars_fragment:Sv,lights_phong_fragment:wv,lights_phong_pars_fragment:Av,lights_physical_fragment:Tv,lights_physical_pars_fragment:Ev,lights_fragment_begin:Cv,lights_fragment_maps:Rv,lights_fragment_end:Iv,lightprobes_pars_fragment:Pv,logdepthbuf_fragment:Lv,logdepthbuf_pars_fragment:Nv,logdepthbuf_pars_vertex:Dv,logdepthbuf_vertex:Uv,map_fragment:Fv,map_pars_fragment:Ov,map_particle_fragment:Bv,map_particle_pars_fragment:kv,metalnessmap_fragment:zv,metalnessmap_pars_fragment:Vv,morphinstance_vertex:Gv,morphcolor_vertex:Hv,morphnormal_vertex:Wv,morphtarget_pars_vertex:Xv,morphtarget_vertex:qv,normal_fragment_begin:$v,normal_fragment_maps:Yv,normal_pars_fragment:Zv,normal_pars_vertex:Jv,normal_vertex:Kv,normalmap_pars_fragment:jv,clearcoat_normal_fragment_begin:Qv,clearcoat_normal_fragment_maps:tb,clearcoat_pars_fragment:eb,iridescence_pars_fragment:nb,opaque_fragment:ib,packing:sb,premultiplied_alpha_fragment:rb,project_vertex:ab,dithering_fragment:ob,dithering_pars_fragment:lb,roughnessmap_fragment:cb,roughnessmap_pars_fragment:hb,shadowmap_pars_fragment:ub,shadowmap_pars_vertex:fb,shadowmap_vertex:db,shadowmask_pars_fragment:pb,skinbase_vertex:mb,skinning_pars_vertex:gb,skinning_vertex:xb,skinnormal_vertex:_b,specularmap_fragment:yb,specularmap_pars_fragment:vb,tonemapping_fragment:bb,tonemapping_pars_fragment:Mb,transmission_fragment:Sb,transmission_pars_fragment:wb,uv_pars_fragment:Ab,uv_pars_vertex:Tb,uv_vertex:Eb,worldpos_vertex:Cb,background_vert:Rb,background_frag:Ib,backgroundCube_vert:Pb,backgroundCube_frag:Lb,cube_vert:Nb,cube_frag:Db,depth_vert:Ub,depth_frag:Fb,distance_vert:Ob,distance_frag:Bb,equirect_vert:kb,equirect_frag:zb,linedashed_vert:Vb,linedashed_frag:Gb,meshbasic_vert:Hb,meshbasic_frag:Wb,meshlambert_vert:Xb,meshlambert_frag:qb,meshmatcap_vert:$b,meshmatcap_frag:Yb,meshnormal_vert:Zb,meshnormal_frag:Jb,meshphong_vert:Kb,meshphong_frag:jb,meshphysical_vert:Qb,meshphysical_frag:tM,meshtoon_vert:eM,meshtoon_frag:nM,points_vert:iM,points_frag:sM,shadow_vert:rM,shadow_frag:aM,sprite_vert:oM,sprite_frag:lM},ft={common:{diffuse:{value:new Yt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Lt},alphaMap:{value:null},alphaMapTransform:{value:new Lt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Lt}},envmap:{envMap:{value:null},envMapRotation:{value:new Lt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Lt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Lt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Lt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Lt},normalScale:{value:new $t(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Lt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Lt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Lt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Lt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Yt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Yt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Lt},alphaTest:{value:0},uvTransform:{value:new Lt}},sprite:{diffuse:{value:new Yt(16777215)},opacity:{value:1},center:{value:new $t(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Lt},alphaMap:{value:null},alphaMapTransform:{value:new Lt},alphaTest:{value:0}}},Ze={basic:{uniforms:ze([ft.common,ft.specularmap,ft.envmap,ft.aomap,ft.lightmap,ft.fog]),vertexShader:zt.meshbasic_vert,fragmentShader:zt.meshbasic_frag},lambert:{uniforms:ze([ft.common,ft.specularmap,ft.envmap,ft.aomap,ft.lightmap,ft.emissivemap,ft.bumpmap,ft.normalmap,ft.displacementmap,ft.fog,ft.lights,{emissive:{value:new Yt(0)},envMapIntensity:{value:1}}]),vertexShader:zt.meshlambert_vert,fragmentShader:zt.meshlambert_frag},phong:{uniforms:ze([ft.common,ft.specularmap,ft.envmap,ft.aomap,ft.lightmap,ft.emissivemap,ft.bumpmap,ft.normalmap,ft.displacementmap,ft.fog,ft.lights,{emissive:{value:new Yt(0)},specular:{value:new Yt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:zt.meshphong_vert,fragmentShader:zt.meshphong_frag},standard:{uniforms:ze([ft.common,ft.envmap,ft.aomap,ft.lightmap,ft.emissivemap,ft.bumpmap,ft.normalmap,ft.displacementmap,ft.roughnessmap,ft.metalnessmap,ft.fog,ft.lights,{emissive:{value:new Yt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:zt.meshphysical_vert,fragmentShader:zt.meshphysical_frag},toon:{uniforms:ze([ft.common,ft.aomap,ft.lightmap,ft.emissivemap,ft.bumpmap,ft.normalmap,ft.displacementmap,ft.gradientmap,ft.fog,ft.lights,{emissive:{value:new Yt(0)}}]),vertexShader:zt.meshtoon_vert,fragmentShader:zt.meshtoon_frag},matcap:{uniforms:ze([ft.common,ft.bumpmap,ft.normalmap,ft.displacementmap,ft.fog,{matcap:{value:null}}]),vertexShader:zt.meshmatcap_vert,fragmentShader:zt.meshmatcap_frag},points:{uniforms:ze([ft.points,ft.fog]),vertexShader:zt.points_vert,fragmentShader:zt.points_frag},dashed:{uniforms:ze([ft.common,ft.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:zt.linedashed_vert,fragmentShader:zt.linedashed_frag},depth:{uniforms:ze([ft.common,ft.displacementmap]),vertexShader:zt.depth_vert,fragmentShader:zt.depth_frag},normal:{uniforms:ze([ft.common,ft.bumpmap,ft.normalmap,ft.displacementmap,{opacity:{value:1}}]),vertexShader:zt.meshnormal_vert,fragmentShader:zt.meshnormal_frag},sprite:{uniforms:ze([ft.sprite,ft.fog]),vertexShader:zt.sprite_vert,fragmentShader:zt.sprite_frag},background:{uniforms:{uvTransform:{value:new Lt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:zt.background_vert,fragmentShader:zt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Lt}},vertexShader:zt.backgroundCube_vert,fragmentShader:zt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:zt.cube_vert,fragmentShader:zt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:zt.equirect_vert,fragmentShader:zt.equirect_frag},distance:{uniforms:ze([ft.common,ft.displacementmap,{referencePosition:{value:new F},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:zt.distance_vert,fragmentShader:zt.distance_frag},shadow:{uniforms:ze([ft.lights,ft.fog,{color:{value:new Yt(0)},opacity:{value:1}}]),vertexShader:zt.shadow_vert,fragmentShader:zt.shadow_frag}};Ze.physical={uniforms:ze([Ze.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Lt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Lt},clearcoatNormalScale:{value:new $t(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Lt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Lt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Lt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Lt},sheen:{value:0},sheenColor:{value:new Yt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Lt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Lt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Lt},transmissionSamplerSize:{value:new $t},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Lt},attenuationDistance:{value:0},attenuationColor:{value:new Yt(0)},specularColor:{value:new Yt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Lt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Lt},anisotropyVector:{value:new $t},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Lt}}]),vertexShader:zt.meshphysical_vert,fragmentShader:zt.meshphysical_frag};var Fl={r:0,b:0,g:0},cM=new ie,Xm=new Lt;Xm.set(-1,0,0,0,1,0,0,0,1);function hM(n,t,e,i,s,r){let a=new Yt(0),o=s===!0?0:1,l,c,h=null,f=0,u=null;function d(M){let A=M.isScene===!0?M.background:null;if(A&&A.isTexture){let b=M.backgroundBlurriness>0;A=t.get(A,b)}return A}function m(M){let A=!1,b=d(M);b===null?p(a,o):b&&b.isColor&&(p(b,1),A=!0);let E=n.xr.getEnvironmentBlendMode();E==="additive"?e.buffers.color.setClear(0,0,0,1,r):E==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(n.autoClear||A)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function _(M,A){let b=d(A);b&&b.isCubeTexture?(c===void 0&&(c=new de(new Xs(1,1,1),new pe({name:"BackgroundCubeMaterial",uniforms:ns(Ze.backgroundCube.uniforms),vertexShader:Ze.backgroundCube.vertexShader,fragmentShader:Ze.backgroundCube.fragmentShader,side:qe,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(E,S,x){this.matrixWorld.copyPosition(x.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(c)),c.material.uniforms.envMap.value=b,c.material.uniforms.backgroundBlurriness.value=A.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=A.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(cM.makeRotationFromEuler(A.backgroundRotation)).transpose(),b.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(Xm),c.material.toneMapped=qt.getTransfer(b.colorSpace)!==jt,(h!==b||f!==b.version||u!==n.toneMapping)&&(c.material.needsUpdate=!0,h=b,f=b.version,u=n.toneMapping),c.layers.enableAll(),M.unshift(c,c.geometry,c.material,0,0,null)):b&&b.isTexture&&(l===void 0&&(l=new de(new Gn(2,2),new pe({name:"BackgroundMaterial",uniforms:ns(Ze.background.uniforms),vertexShader:Ze.background.vertexShader,fragmentShader:Ze.background.fragmentShader,side:Ri,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(l)),l.material.uniforms.t2D.value=b,l.material.uniforms.backgroundIntensity.value=A.backgroundIntensity,l.material.toneMapped=qt.getTransfer(b.colorSpace)!==jt,b.matrixAutoUpdate===!0&&b.updateMatrix(),l.material.uniforms.uvTransform.value.copy(b.matrix),(h!==b||f!==b.version||u!==n.toneMapping)&&(l.material.needsUpdate=!0,h=b,f=b.version,u=n.toneMapping),l.layers.enableAll(),M.unshift(l,l.geometry,l.material,0,0,null))}function p(M,A){M.getRGB(Fl,jh(n)),e.buffers.color.setClear(Fl.r,Fl.g,Fl.b,A,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return a},setClearColor:function(M,A=1){a.set(M),o=A,p(a,o)},getClearAlpha:function(){return o},setClearAlpha:function(M){o=M,p(a,o)},render:m,addToRenderList:_,dispose:g}}function uM(n,t){let e=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=u(null),r=s,a=!1;function o(D,N,V,I,W){let Y=!1,G=f(D,I,V,N);r!==G&&(r=G,c(r.object)),Y=d(D,I,V,W),Y&&m(D,I,V,W),W!==null&&t.update(W,n.ELEMENT_ARRAY_BUFFER),(Y||a)&&(a=!1,b(D,N,V,I),W!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,t.get(W).buffer))}function l(){return n.createVertexArray()}function c(D){return n.bindVertexArray(D)}function h(D){return n.deleteVertexArray(D)}function f(D,N,V,I){let W=I.wireframe===!0,Y=i[N.id];Y===void 0&&(Y={},i[N.id]=Y);let G=D.isInstancedMesh===!0?D.id:0,tt=Y[G];tt===void 0&&(tt={},Y[G]=tt);let X=tt[V.id];X===void 0&&(X={},tt[V.id]=X);let j=X[W];return j===void 0&&(j=u(l()),X[W]=j),j}function u(D){let N=[],V=[],I=[];for(let W=0;W<e;W++)N[W]=0,V[W]=0,I[W]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:N,enabledAttributes:V,attributeDivisors:I,object:D,attributes:{},index:null}}function d(D,N,V,I){let W=r.attributes,Y=N.attributes,G=0,tt=V.getAttributes();for(let X in tt)if(tt[X].location>=0){let et=W[X],Mt=Y[X];if(Mt===void 0&&(X==="instanceMatrix"&&D.instanceMatrix&&(Mt=D.instanceMatrix),X==="instanceColor"&&D.instanceColor&&(Mt=D.instanceColor)),et===void 0||et.attribute!==Mt||Mt&&et.data!==Mt.data)return!0;G++}return r.attributesNum!==G||r.index!==I}function m(D,N,V,I){let W={},Y=N.attributes,G=0,tt=V.getAttributes();for(let X in tt)if(tt[X].location>=0){let et=Y[X];et===void 0&&(X==="instanceMatrix"&&D.instanceMatrix&&(et=D.instanceMatrix),X==="instanceColor"&&D.instanceColor&&(et=D.instanceColor));let Mt={};Mt.attribute=et,et&&et.data&&(Mt.data=et.data),W[X]=Mt,G++}r.attributes=W,r.attributesNum=G,r.index=I}function _(){let D=r.newAttributes;for(let N=0,V=D.length;N<V;N++)D[N]=0}function p(D){g(D,0)}function g(D,N){let V=r.newAttributes,I=r.enabledAttributes,W=r.attributeDivisors;V[D]=1,I[D]===0&&(n.enableVertexAttribArray(D),I[D]=1),W[D]!==N&&(n.vertexAttribDivisor(D,N),W[D]=N)}function M(){let D=r.newAttributes,N=r.enabledAttributes;for(let V=0,I=N.length;V<I;V++)N[V]!==D[V]&&(n.disableVertexAttribArray(V),N[V]=0)}function A(D,N,V,I,W,Y,G){G===!0?n.vertexAttribIPointer(D,N,V,W,Y):n.vertexAttribPointer(D,N,V,I,W,Y)}function b(D,N,V,I){_();let W=I.attributes,Y=V.getAttributes(),G=N.defaultAttributeValues;for(let tt in Y){let X=Y[tt];if(X.location>=0){let j=W[tt];if(j===void 0&&(tt==="instanceMatrix"&&D.instanceMatrix&&(j=D.instanceMatrix),tt==="instanceColor"&&D.instanceColor&&(j=D.instanceColor)),j!==void 0){let et=j.normalized,Mt=j.itemSize,Dt=t.get(j);if(Dt===void 0)continue;let J=Dt.buffer,mt=Dt.type,yt=Dt.bytesPerElement,Et=mt===n.INT||mt===n.UNSIGNED_INT||j.gpuType===Qo;if(j.isInterleavedBufferAttribute){let gt=j.data,Ft=gt.isInterleavedBuffer===!0?gt.stride:gt.itemSize,me=j.offset;if(gt.isInstancedInterleavedBuffer||gt.isInstancedBufferAttribute){for(let It=0;It<X.locationSize;It++)g(X.location+It,gt.meshPerAttribute);D.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=gt.meshPerAttribute*gt.count)}else for(let It=0;It<X.locationSize;It++)p(X.location+It);n.bindBuffer(n.ARRAY_BUFFER,J);for(let It=0;It<X.locationSize;It++)A(X.location+It,Mt/X.locationSize,mt,et,Ft*yt,(me+Mt/X.locationSize*It)*yt,Et)}else{if(j.isInstancedBufferAttribute){for(let gt=0;gt<X.locationSize;gt++)g(X.location+gt,j.meshPerAttribute);D.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=j.meshPerAttribute*j.count)}else for(let gt=0;gt<X.locationSize;gt++)p(X.location+gt);n.bindBuffer(n.ARRAY_BUFFER,J);for(let gt=0;gt<X.locationSize;gt++)A(X.location+gt,Mt/X.locationSize,mt,et,Mt*yt,Mt/X.locationSize*gt*yt,Et)}}else if(G!==void 0){let et=G[tt];if(et!==void 0)switch(et.length){case 2:n.vertexAttrib2fv(X.location,et);break;case 3:n.vertexAttrib3fv(X.location,et);break;case 4:n.vertexAttrib4fv(X.location,et);break;default:n.vertexAttrib1fv(X.location,et)}}}}M()}function E(){O();for(let D in i){let N=i[D];for(let V in N){let I=N[V];for(let W in I){let Y=I[W];for(let G in Y)h(Y[G].object),delete Y[G];delete I[W]}}delete i[D]}}function S(D){if(i[D.id]===void 0)return;let N=i[D.id];for(let V in N){let I=N[V];for(let W in I){let Y=I[W];for(let G in Y)h(Y[G].object),delete Y[G];delete I[W]}}delete i[D.id]}function x(D){for(let N in i){let V=i[N];for(let I in V){let W=V[I];if(W[D.id]===void 0)continue;let Y=W[D.id];for(let G in Y)h(Y[G].object),delete Y[G];delete W[D.id]}}}function w(D){for(let N in i){let V=i[N],I=D.isInstancedMesh===!0?D.id:0,W=V[I];if(W!==void 0){for(let Y in W){let G=W[Y];for(let tt in G)h(G[tt].object),delete G[tt];delete W[Y]}delete V[I],Object.keys(V).length===0&&delete i[N]}}}function O(){P(),a=!0,r!==s&&(r=s,c(r.object))}function P(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:o,reset:O,resetDefaultState:P,dispose:E,releaseStatesOfGeometry:S,releaseStatesOfObject:w,releaseStatesOfProgram:x,initAttributes:_,enableAttribute:p,disableUnusedAttributes:M}}function fM(n,t,e){let i;function s(l){i=l}function r(l,c){n.drawArrays(i,l,c),e.update(c,i,1)}function a(l,c,h){h!==0&&(n.drawArraysInstanced(i,l,c,h),e.update(c,i,h))}function o(l,c,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,l,0,c,0,h);let u=0;for(let d=0;d<h;d++)u+=c[d];e.update(u,i,1)}this.setMode=s,this.render=r,this.renderInstances=a,this.renderMultiDraw=o}function dM(n,t,e,i){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let x=t.get("EXT_texture_filter_anisotropic");s=n.getParameter(x.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function a(x){return!(x!==cn&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function o(x){let w=x===In&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(x!==$e&&x!==Rn&&!w&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function l(x){if(x==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";x="mediump"}return x==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",h=l(c);h!==c&&(Rt("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let f=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),u=e.logarithmicDepthBuffer===!0&&f===!1;e.reversedDepthBuffer===!0&&f===!1&&Rt("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&f===!0&&Rt("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),m=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),_=n.getParameter(n.MAX_TEXTURE_SIZE),p=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),g=n.getParameter(n.MAX_VERTEX_ATTRIBS),M=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),A=n.getParameter(n.MAX_VARYING_VECTORS),b=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),E=n.getParameter(n.MAX_SAMPLES),S=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:a,textureTypeReadable:o,precision:c,logarithmicDepthBuffer:u,reversedDepthBuffer:f,maxTextures:d,maxVertexTextures:m,maxTextureSize:_,maxCubemapSize:p,maxAttributes:g,maxVertexUniforms:M,maxVaryings:A,maxFragmentUniforms:b,maxSamples:E,samples:S}}function pM(n){let t=this,e=null,i=0,s=!1,r=!1,a=new En,o=new Lt,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(f,u){let d=f.length!==0||u||i!==0||s;return s=u,i=f.length,d},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(f,u){e=h(f,u,0)},this.setState=function(f,u,d){let m=f.clippingPlanes,_=f.clipIntersection,p=f.clipShadows,g=n.get(f);if(!s||m===null||m.length===0||r&&!p)r?h(null):c();else{let M=r?0:i,A=M*4,b=g.clippingState||null;l.value=b,b=h(m,u,A,d);for(let E=0;E!==A;++E)b[E]=e[E];g.clippingState=b,this.numIntersection=_?this.numPlanes:0,this.numPlanes+=M}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=i>0),t.numPlanes=i,t.numIntersection=0}function h(f,u,d,m){let _=f!==null?f.length:0,p=null;if(_!==0){if(p=l.value,m!==!0||p===null){let g=d+_*4,M=u.matrixWorldInverse;o.getNormalMatrix(M),(p===null||p.length<g)&&(p=new Float32Array(g));for(let A=0,b=d;A!==_;++A,b+=4)a.copy(f[A]).applyMatrix4(M,o),a.normal.toArray(p,b),p[b+3]=a.constant}l.value=p,l.needsUpdate=!0}return t.numPlanes=_,t.numIntersection=0,p}}var ea=class extends Ie{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let i={width:t,height:t,depth:1},s=[i,i,i,i,i,i];this.texture=new Dr(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Xs(5,5,5),r=new pe({name:"CubemapFromEquirect",uniforms:ns(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:qe,blending:ji});r.uniforms.tEquirect.value=e;let a=new de(s,r),o=e.minFilter;return e.minFilter===si&&(e.minFilter=fe),new qs(1,10,this).update(t,a),e.minFilter=o,a.geometry.dispose(),a.material.dispose(),this}clear(t,e=!0,i=!0,s=!0){let r=t.getRenderTarget();for(let a=0;a<6;a++)t.setRenderTarget(this,a),t.clear(e,i,s);t.setRenderTarget(r)}},Sm=256,mM=3,gM=20,qm=256,$m=16,xM=3,_M=new F,yM=new Yt,Bl=class n{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new qs(1,10,null),this._boxMesh=new de(new Xs(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,i=.1,s=100,r={}){let{size:a=256,position:o=_M}=r,l=this._renderer;this._setSize(a);let c=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let f=l.autoClear,u=l.autoClearColor,d=l.autoClearDepth,m=l.autoClearStencil,_=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,_===null&&(t.background=l.getClearColor(yM));let p=new qs(i,s,h);return p.position.copy(o),p.update(l,t),l.autoClear=f,l.autoClearColor=u,l.autoClearDepth=d,l.autoClearStencil=m,t.background=_,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Tm(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=Am(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(Sm,Yh(t))}_fromTexture(t,e){t.mapping===ts||t.mapping===Zs?this._setSize(t.image.length===0?Sm:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let i=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(i),i}_allocateTarget(){let t=this._cubeSize,e=wm(t,!1,!1),i=Math.log2(t)-mM;for(let s=0;s<=i;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==e||t&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=wm(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=t,r.activeMipmapLevel=e;let a=t.width>>e;t.viewport.set(0,0,a,a),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===ts||t.mapping===Zs?(this._cubemapMaterial===null&&(this._cubemapMaterial=Tm()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=Am()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=vM(),this._integrationMaterial=bM());let e=this._cubeSize,i=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/$m);for(let a=0;a<=i;a++){let o=n.lodToRoughness(a,i);if(a>i-xM)r.roughness.value=o,this._renderCube(t,a,this._integrationMaterial);else{let l=o>0?Math.log2(e)+.5*Math.log2(6/(qm*Math.pow(o,4)))+.5:0;s.roughness.value=o,s.lodBias.value=l,this._renderCube(t,a,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=MM());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,i),s.envMap.value=t.texture,this._renderCube(r,0,i)}};function wm(n,t,e){return new ea(n,{minFilter:si,generateMipmaps:t,type:In,colorSpace:Zi,depthBuffer:e})}function na(n,t,e){return new pe({name:n,uniforms:t,vertexShader:zt.cube_vert,fragmentShader:e,side:qe,blending:ji,depthTest:!1,depthWrite:!1})}function vM(){return na("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${qm}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function bM(){return na("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:$m}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function MM(){return na("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${gM}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function Am(){return na("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function Tm(){return na("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function SM(n){let t=new WeakMap,e=new WeakMap,i=null;function s(u,d=!1){return u==null?null:d?a(u):r(u)}function r(u){if(u&&u.isTexture){let d=u.mapping;if(d===Jo||d===Ko)if(t.has(u)){let m=t.get(u).texture;return o(m,u.mapping)}else{let m=u.image;if(m&&m.height>0){let _=new ea(m.height);return _.fromEquirectangularTexture(n,u),t.set(u,_),u.addEventListener("dispose",c),o(_.texture,u.mapping)}else return null}}return u}function a(u){if(u&&u.isTexture&&u.isPMREMTexture!==!0){let d=u.mapping,m=d===Jo||d===Ko,_=d===ts||d===Zs;if(m||_){let p=e.get(u),g=p!==void 0?p.texture.pmremVersion:0;if(u.isRenderTargetTexture&&u.pmremVersion!==g)return i===null&&(i=new Bl(n)),p=m?i.fromEquirectangular(u,p):i.fromCubemap(u,p),p.texture.pmremVersion=u.pmremVersion,e.set(u,p),p.texture;if(p!==void 0)return p.texture;{let M=u.image;return m&&M&&M.height>0||_&&M&&l(M)?(i===null&&(i=new Bl(n)),p=m?i.fromEquirectangular(u):i.fromCubemap(u),p.texture.pmremVersion=u.pmremVersion,e.set(u,p),u.addEventListener("dispose",h),p.texture):null}}}return u}function o(u,d){return d===Jo?u.mapping=ts:d===Ko&&(u.mapping=Zs),u}function l(u){let d=0,m=6;for(let _=0;_<m;_++)u[_]!==void 0&&d++;return d===m}function c(u){let d=u.target;d.removeEventListener("dispose",c);let m=t.get(d);m!==void 0&&(t.delete(d),m.dispose())}function h(u){let d=u.target;d.removeEventListener("dispose",h);let m=e.get(d);m!==void 0&&(e.delete(d),m.dispose())}function f(){t=new WeakMap,e=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:f}}function wM(n){let t={};function e(i){if(t[i]!==void 0)return t[i];let s=n.getExtension(i);return t[i]=s,s}return{has:function(i){return e(i)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(i){let s=e(i);return s===null&&br("WebGLRenderer: "+i+" extension not supported."),s}}}function AM(n,t,e,i){let s={},r=new WeakMap,a=new FinalizationRegistry(m=>delete s[m]);function o(m){l(m.target)}function l(m){m.index!==null&&t.remove(m.index);for(let p in m.attributes)t.remove(m.attributes[p]);m.removeEventListener("dispose",o),delete s[m.id],a.unregister(m);let _=r.get(m);_&&(t.remove(_),r.delete(m)),i.releaseStatesOfGeometry(m),m.isInstancedBufferGeometry===!0&&delete m._maxInstanceCount,e.memory.geometries--}function c(m,_){return s[_.id]!==void 0||(_.addEventListener("dispose",o),s[_.id]=new WeakRef(_),a.register(_,_.id,_),e.memory.geometries++),_}function h(m){let _=m.attributes;for(let p in _)t.update(_[p],n.ARRAY_BUFFER)}function f(m){let _=m.index,p=m.attributes.position,g=0;if(p===void 0)return;let M=_!==null?_.array.length:p.array.length/3-1,A=p.count>=65535?Lr:Pr,b=new A(Math.ceil(M/3)*6,1),E=b.array;if(_!==null){let x=_.array;g=_.version;for(let w=0,O=0;w<M;w+=3){let P=x[w+0],D=x[w+1],N=x[w+2];E[O++]=P,E[O++]=D,E[O++]=D,E[O++]=N,E[O++]=N,E[O++]=P}}else{g=p.version;for(let x=0,w=0;x<M;x+=3){let O=x+0,P=x+1,D=x+2;E[w++]=O,E[w++]=P,E[w++]=P,E[w++]=D,E[w++]=D,E[w++]=O}}b.version=g;let S=r.get(m);S&&t.remove(S),r.set(m,b)}function u(m){let _=r.get(m);if(_){let p=m.index;p!==null&&_.version<p.version&&f(m)}else f(m);return r.get(m)}function d(){for(let m in s){let _=s[m].deref();_!==void 0&&l(_)}}return{get:c,update:h,getWireframeAttribute:u,dispose:d}}function TM(n,t,e){let i;function s(f){i=f}let r,a;function o(f){r=f.type,a=f.bytesPerElement}function l(f,u){n.drawElements(i,u,r,f*a),e.update(u,i,1)}function c(f,u,d){d!==0&&(n.drawElementsInstanced(i,u,r,f*a,d),e.update(u,i,d))}function h(f,u,d){if(d===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,u,0,r,f,0,d);let _=0;for(let p=0;p<d;p++)_+=u[p];e.update(_,i,1)}this.setMode=s,this.setIndex=o,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function EM(n){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,a,o){switch(e.calls++,a){case n.TRIANGLES:e.triangles+=o*(r/3);break;case n.LINES:e.lines+=o*(r/2);break;case n.LINE_STRIP:e.lines+=o*(r-1);break;case n.LINE_LOOP:e.lines+=o*r;break;case n.POINTS:e.points+=o*r;break;default:Pt("WebGLInfo: Unknown draw mode:",a);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:i}}function CM(n,t,e){let i=new WeakMap,s=new Kt;function r(a,o,l){let c=a.morphTargetInfluences,h=o.morphAttributes.position||o.morphAttributes.normal||o.morphAttributes.color,f=h!==void 0?h.length:0,u=i.get(o);if(u===void 0||u.count!==f){let O=function(){x.dispose(),i.delete(o),o.removeEventListener("dispose",O)};u!==void 0&&u.texture.dispose();let d=o.morphAttributes.position!==void 0,m=o.morphAttributes.normal!==void 0,_=o.morphAttributes.color!==void 0,p=o.morphAttributes.position||[],g=o.morphAttributes.normal||[],M=o.morphAttributes.color||[],A=0;d===!0&&(A=1),m===!0&&(A=2),_===!0&&(A=3);let b=o.attributes.position.count*A,E=1;b>t.maxTextureSize&&(E=Math.ceil(b/t.maxTextureSize),b=t.maxTextureSize);let S=new Float32Array(b*E*4*f),x=new Rr(S,b,E,f);x.type=Rn,x.needsUpdate=!0;let w=A*4;for(let P=0;P<f;P++){let D=p[P],N=g[P],V=M[P],I=b*E*4*P;for(let W=0;W<D.count;W++){let Y=W*w;d===!0&&(s.fromBufferAttribute(D,W),S[I+Y+0]=s.x,S[I+Y+1]=s.y,S[I+Y+2]=s.z,S[I+Y+3]=0),m===!0&&(s.fromBufferAttribute(N,W),S[I+Y+4]=s.x,S[I+Y+5]=s.y,S[I+Y+6]=s.z,S[I+Y+7]=0),_===!0&&(s.fromBufferAttribute(V,W),S[I+Y+8]=s.x,S[I+Y+9]=s.y,S[I+Y+10]=s.z,S[I+Y+11]=V.itemSize===4?s.w:1)}}u={count:f,texture:x,size:new $t(b,E)},i.set(o,u),o.addEventListener("dispose",O)}if(a.isInstancedMesh===!0&&a.morphTexture!==null)l.getUniforms().setValue(n,"morphTexture",a.morphTexture,e);else{let d=0;for(let _=0;_<c.length;_++)d+=c[_];let m=o.morphTargetsRelative?1:1-d;l.getUniforms().setValue(n,"morphTargetBaseInfluence",m),l.getUniforms().setValue(n,"morphTargetInfluences",c)}l.getUniforms().setValue(n,"morphTargetsTexture",u.texture,e),l.getUniforms().setValue(n,"morphTargetsTextureSize",u.size)}return{update:r}}function RM(n,t,e,i,s){let r=new WeakMap;function a(c){let h=s.render.frame,f=c.geometry,u=t.get(c,f);if(r.get(u)!==h&&(t.update(u),r.set(u,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(e.update(c.instanceMatrix,n.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,n.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let d=c.skeleton;r.get(d)!==h&&(d.update(),r.set(d,h))}return u}function o(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),i.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:a,dispose:o}}var IM={[Ch]:"LINEAR_TONE_MAPPING",[Rh]:"REINHARD_TONE_MAPPING",[Ih]:"CINEON_TONE_MAPPING",[Ph]:"ACES_FILMIC_TONE_MAPPING",[Nh]:"AGX_TONE_MAPPING",[Dh]:"NEUTRAL_TONE_MAPPING",[Lh]:"CUSTOM_TONE_MAPPING"};function PM(n,t,e,i,s,r){let a=new Ie(t,e,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),o=null,l=null,c=null,h=new ve;h.setAttribute("position",new ke([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new ke([0,2,0,0,2,0],2));let f=new Fo({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),u=new de(h,f),d=new Ei(-1,1,1,-1,0,1),m=null,_=null,p=!1,g,M=null,A=[],b=!1;this.setSize=function(E,S){a.setSize(E,S),o!==null&&o.setSize(E,S),l!==null&&l.setSize(E,S);for(let x=0;x<A.length;x++){let w=A[x];w.setSize&&w.setSize(E,S)}},this.setEffects=function(E){A=E,b=A.length>0&&A[0].isRenderPass===!0;let S=a.width,x=a.height;A.length>0&&o===null&&(o=new Ie(S,x,{type:In,depthBuffer:!1,stencilBuffer:!1}),l=new Ie(S,x,{type:In,depthBuffer:!1,stencilBuffer:!1}));let w=s===!0&&A.some(O=>O.needsDepthTexture===!0);w!==(a.depthTexture!==null)&&(w===!0&&c===null&&(c=new on(S,x),r===!0&&(c.format=ri,c.type=es)),a.dispose(),a.depthTexture=w?c:null,a.resolveDepthBuffer=w,a.storeMultisampledDepthBuffer=w);for(let O=0;O<A.length;O++){let P=A[O];P.setSize&&P.setSize(S,x),w&&P.needsDepthTexture===!0&&P.setDepthTexture&&P.setDepthTexture(c)}},this.begin=function(E,S){if(p||E.toneMapping===Hn&&A.length===0)return!1;if(M=S,S!==null){let x=S.width,w=S.height;(a.width!==x||a.height!==w)&&this.setSize(x,w)}return b===!1&&E.setRenderTarget(a),g=E.toneMapping,E.toneMapping=Hn,!0},this.hasRenderPass=function(){return b},this.end=function(E,S){E.toneMapping=g,p=!0;let x=a,w=o;for(let O=0;O<A.length;O++){let P=A[O];P.enabled!==!1&&(P.render(E,w,x,S),P.needsSwap!==!1&&(x=w,w=w===o?l:o))}if(m!==E.outputColorSpace||_!==E.toneMapping){m=E.outputColorSpace,_=E.toneMapping,f.defines={},qt.getTransfer(m)===jt&&(f.defines.SRGB_TRANSFER="");let O=IM[_];O&&(f.defines[O]=""),f.needsUpdate=!0}f.uniforms.tDiffuse.value=x.texture,E.setRenderTarget(M),E.render(u,d),M=null,p=!1},this.isCompositing=function(){return p},this.dispose=function(){a.dispose(),o!==null&&o.dispose(),l!==null&&l.dispose(),h.dispose(),f.dispose()}}var Ym=new Qe,Zm=new on(1,1),Jm=new Ur(1),Km=new Rr,jm=new Po,Qm=new Dr,Em=[],Cm=[],Rm=new Float32Array(16),Im=new Float32Array(9),Pm=new Float32Array(4);function js(n,t,e){let i=n[0];if(i<=0||i>0)return n;let s=t*e,r=Em[s];if(r===void 0&&(r=new Float32Array(s),Em[s]=r),t!==0){i.toArray(r,0);for(let a=1,o=0;a!==t;++a)o+=e,n[a].toArray(r,o)}return r}function be(n,t){if(n.length!==t.length)return!1;for(let e=0,i=n.length;e<i;e++)if(n[e]!==t[e])return!1;return!0}function Me(n,t){for(let e=0,i=t.length;e<i;e++)n[e]=t[e]}function zl(n,t){let e=Cm[t];e===void 0&&(e=new Int32Array(t),Cm[t]=e);for(let i=0;i!==t;++i)e[i]=n.allocateTextureUnit();return e}function LM(n,t){let e=this.cache;e[0]!==t&&(n.uniform1f(this.addr,t),e[0]=t)}function NM(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(be(e,t))return;n.uniform2fv(this.addr,t),Me(e,t)}}function DM(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(n.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(be(e,t))return;n.uniform3fv(this.addr,t),Me(e,t)}}function UM(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(be(e,t))return;n.uniform4fv(this.addr,t),Me(e,t)}}function FM(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(be(e,t))return;n.uniformMatrix2fv(this.addr,!1,t),Me(e,t)}else{if(be(e,i))return;Pm.set(i),n.uniformMatrix2fv(this.addr,!1,Pm),Me(e,i)}}function OM(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(be(e,t))return;n.uniformMatrix3fv(this.addr,!1,t),Me(e,t)}else{if(be(e,i))return;Im.set(i),n.uniformMatrix3fv(this.addr,!1,Im),Me(e,i)}}function BM(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(be(e,t))return;n.uniformMatrix4fv(this.addr,!1,t),Me(e,t)}else{if(be(e,i))return;Rm.set(i),n.uniformMatrix4fv(this.addr,!1,Rm),Me(e,i)}}function kM(n,t){let e=this.cache;e[0]!==t&&(n.uniform1i(this.addr,t),e[0]=t)}function zM(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(be(e,t))return;n.uniform2iv(this.addr,t),Me(e,t)}}function VM(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(be(e,t))return;n.uniform3iv(this.addr,t),Me(e,t)}}function GM(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(be(e,t))return;n.uniform4iv(this.addr,t),Me(e,t)}}function HM(n,t){let e=this.cache;e[0]!==t&&(n.uniform1ui(this.addr,t),e[0]=t)}function WM(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(be(e,t))return;n.uniform2uiv(this.addr,t),Me(e,t)}}function XM(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(be(e,t))return;n.uniform3uiv(this.addr,t),Me(e,t)}}function qM(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(be(e,t))return;n.uniform4uiv(this.addr,t),Me(e,t)}}function Vl(n){return n.version===0&&(n.compareFunction=Xh,n.needsUpdate=!0),n}function $M(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=Vl(Zm):r=Ym,e.setTexture2D(t||r,s)}function YM(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),e.setTexture3D(t||jm,s)}function ZM(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=Vl(Jm):r=Qm,e.setTextureCube(t||r,s)}function JM(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),e.setTexture2DArray(t||Km,s)}function KM(n){switch(n){case 5126:return LM;case 35664:return NM;case 35665:return DM;case 35666:return UM;case 35674:return FM;case 35675:return OM;case 35676:return BM;case 5124:case 35670:return kM;case 35667:case 35671:return zM;case 35668:case 35672:return VM;case 35669:case 35673:return GM;case 5125:return HM;case 36294:return WM;case 36295:return XM;case 36296:return qM;case 35678:case 36198:case 36298:case 36306:case 35682:return $M;case 35679:case 36299:case 36307:return YM;case 35680:case 36300:case 36308:case 36293:return ZM;case 36289:case 36303:case 36311:case 36292:return JM}}function jM(n,t){n.uniform1fv(this.addr,t)}function QM(n,t){let e=js(t,this.size,2);n.uniform2fv(this.addr,e)}function tS(n,t){let e=js(t,this.size,3);n.uniform3fv(this.addr,e)}function eS(n,t){let e=js(t,this.size,4);n.uniform4fv(this.addr,e)}function nS(n,t){let e=js(t,this.size,4);n.uniformMatrix2fv(this.addr,!1,e)}function iS(n,t){let e=js(t,this.size,9);n.uniformMatrix3fv(this.addr,!1,e)}function sS(n,t){let e=js(t,this.size,16);n.uniformMatrix4fv(this.addr,!1,e)}function rS(n,t){n.uniform1iv(this.addr,t)}function aS(n,t){n.uniform2iv(this.addr,t)}function oS(n,t){n.uniform3iv(this.addr,t)}function lS(n,t){n.uniform4iv(this.addr,t)}function cS(n,t){n.uniform1uiv(this.addr,t)}function hS(n,t){n.uniform2uiv(this.addr,t)}function uS(n,t){n.uniform3uiv(this.addr,t)}function fS(n,t){n.uniform4uiv(this.addr,t)}function dS(n,t,e){let i=this.cache,s=t.length,r=zl(e,s);be(i,r)||(n.uniform1iv(this.addr,r),Me(i,r));let a;this.type===n.SAMPLER_2D_SHADOW?a=Vl(Zm):a=Ym;for(let o=0;o!==s;++o)e.setTexture2D(t[o]||a,r[o])}function pS(n,t,e){let i=this.cache,s=t.length,r=zl(e,s);be(i,r)||(n.uniform1iv(this.addr,r),Me(i,r));for(let a=0;a!==s;++a)e.setTexture3D(t[a]||jm,r[a])}function mS(n,t,e){let i=this.cache,s=t.length,r=zl(e,s);be(i,r)||(n.uniform1iv(this.addr,r),Me(i,r));let a;this.type===n.SAMPLER_CUBE_SHADOW?a=Vl(Jm):a=Qm;for(let o=0;o!==s;++o)e.setTextureCube(t[o]||a,r[o])}function gS(n,t,e){let i=this.cache,s=t.length,r=zl(e,s);be(i,r)||(n.uniform1iv(this.addr,r),Me(i,r));for(let a=0;a!==s;++a)e.setTexture2DArray(t[a]||Km,r[a])}function xS(n){switch(n){case 5126:return jM;case 35664:return QM;case 35665:return tS;case 35666:return eS;case 35674:return nS;case 35675:return iS;case 35676:return sS;case 5124:case 35670:return rS;case 35667:case 35671:return aS;case 35668:case 35672:return oS;case 35669:case 35673:return lS;case 5125:return cS;case 36294:return hS;case 36295:return uS;case 36296:return fS;case 35678:case 36198:case 36298:case 36306:case 35682:return dS;case 35679:case 36299:case 36307:return pS;case 35680:case 36300:case 36308:case 36293:return mS;case 36289:case 36303:case 36311:case 36292:return gS}}var su=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.setValue=KM(e.type)}},ru=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=xS(e.type)}},au=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,i){let s=this.seq;for(let r=0,a=s.length;r!==a;++r){let o=s[r];o.setValue(t,e[o.id],i)}}},nu=/(\w+)(\])?(\[|\.)?/g;function Lm(n,t){n.seq.push(t),n.map[t.id]=t}function _S(n,t,e){let i=n.name,s=i.length;for(nu.lastIndex=0;;){let r=nu.exec(i),a=nu.lastIndex,o=r[1],l=r[2]==="]",c=r[3];if(l&&(o=o|0),c===void 0||c==="["&&a+2===s){Lm(e,c===void 0?new su(o,n,t):new ru(o,n,t));break}else{let f=e.map[o];f===void 0&&(f=new au(o),Lm(e,f)),e=f}}}var Ks=class{constructor(t,e){this.seq=[],this.map={};let i=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let a=0;a<i;++a){let o=t.getActiveUniform(e,a),l=t.getUniformLocation(e,o.name);_S(o,l,this)}let s=[],r=[];for(let a of this.seq)a.type===t.SAMPLER_2D_SHADOW||a.type===t.SAMPLER_CUBE_SHADOW||a.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(a):r.push(a);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,i,s){let r=this.map[e];r!==void 0&&r.setValue(t,i,s)}setOptional(t,e,i){let s=e[i];s!==void 0&&this.setValue(t,i,s)}static upload(t,e,i,s){for(let r=0,a=e.length;r!==a;++r){let o=e[r],l=i[o.id];l.needsUpdate!==!1&&o.setValue(t,l.value,s)}}static seqWithValue(t,e){let i=[];for(let s=0,r=t.length;s!==r;++s){let a=t[s];a.id in e&&i.push(a)}return i}};function Nm(n,t,e){let i=n.createShader(t);return n.shaderSource(i,e),n.compileShader(i),i}var yS=37297,vS=0;function bS(n,t){let e=n.split(`
`),i=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let a=s;a<r;a++){let o=a+1;i.push(`${o===t?">":" "} ${o}: ${e[a]}`)}return i.join(`
`)}var Dm=new Lt;function MS(n){qt._getMatrix(Dm,qt.workingColorSpace,n);let t=`mat3( ${Dm.elements.map(e=>e.toFixed(4))} )`;switch(qt.getTransfer(n)){case Ar:return[t,"LinearTransferOETF"];case jt:return[t,"sRGBTransferOETF"];default:return Rt("WebGLProgram: Unsupported color space: ",n),[t,"LinearTransferOETF"]}}function Um(n,t,e){let i=n.getShaderParameter(t,n.COMPILE_STATUS),r=(n.getShaderInfoLog(t)||"").trim();if(i&&r==="")return"";let a=/ERROR: 0:(\d+)/.exec(r);if(a){let o=parseInt(a[1]);return e.toUpperCase()+`

`+r+`

`+bS(n.getShaderSource(t),o)}else return r}function SS(n,t){let e=MS(t);return[`vec4 ${n}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var wS={[Ch]:"Linear",[Rh]:"Reinhard",[Ih]:"Cineon",[Ph]:"ACESFilmic",[Nh]:"AgX",[Dh]:"Neutral",[Lh]:"Custom"};function AS(n,t){let e=wS[t];return e===void 0?(Rt("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var Ol=new F;function TS(){qt.getLuminanceCoefficients(Ol);let n=Ol.x.toFixed(4),t=Ol.y.toFixed(4),e=Ol.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function ES(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(ta).join(`
`)}function CS(n){let t=[];for(let e in n){let i=n[e];i!==!1&&t.push("#define "+e+" "+i)}return t.join(`
`)}function RS(n,t){let e={},i=n.getProgramParameter(t,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(t,s),a=r.name,o=1;r.type===n.FLOAT_MAT2&&(o=2),r.type===n.FLOAT_MAT3&&(o=3),r.type===n.FLOAT_MAT4&&(o=4),e[a]={type:r.type,location:n.getAttribLocation(t,a),locationSize:o}}return e}function ta(n){return n!==""}function Fm(n,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function Om(n,t){return n.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var IS=/^[ \t]*#include +<([\w\d./]+)>/gm;function ou(n){return n.replace(IS,PS)}function PS(n,t){let e=zt[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return ou(e)}var LS=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function Bm(n){return n.replace(LS,NS)}function NS(n,t,e,i){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function km(n){let t=`precision ${n.precision} float;
	precision ${n.precision} int;
	precision ${n.precision} sampler2D;
	precision ${n.precision} samplerCube;
	precision ${n.precision} sampler3D;
	precision ${n.precision} sampler2DArray;
	precision ${n.precision} sampler2DShadow;
	precision ${n.precision} samplerCubeShadow;
	precision ${n.precision} sampler2DArrayShadow;
	precision ${n.precision} isampler2D;
	precision ${n.precision} isampler3D;
	precision ${n.precision} isamplerCube;
	precision ${n.precision} isampler2DArray;
	precision ${n.precision} usampler2D;
	precision ${n.precision} usampler3D;
	precision ${n.precision} usamplerCube;
	precision ${n.precision} usampler2DArray;
	`;return n.precision==="highp"?t+=`
#define HIGH_PRECISION`:n.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:n.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var DS={[Gr]:"SHADOWMAP_TYPE_PCF",[$s]:"SHADOWMAP_TYPE_VSM"};function US(n){return DS[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var FS={[Zs]:"ENVMAP_MODE_REFRACTION"};function OS(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":FS[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var BS={[Eh]:"ENVMAP_BLENDING_MULTIPLY",[rm]:"ENVMAP_BLENDING_MIX",[am]:"ENVMAP_BLENDING_ADD"};function kS(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":BS[n.combine]||"ENVMAP_BLENDING_NONE"}function zS(n,t,e,i){let s=n.getContext(),r=e.defines,a=e.vertexShader,o=e.fragmentShader,l=US(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=OS(e),f=kS(e),u=ES(e),d=CS(r),m=s.createProgram(),_,p,g=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(_=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(ta).join(`
`),_.length>0&&(_+=`
`),p=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(ta).join(`
`),p.length>0&&(p+=`
`)):(_=[km(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(ta).join(`
`),p=[km(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+f:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Hn?"#define TONE_MAPPING":"",e.toneMapping!==Hn?zt.tonemapping_pars_fragment:"",e.toneMapping!==Hn?AS("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",zt.colorspace_pars_fragment,SS("linearToOutputTexel",e.outputColorSpace),TS(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(ta).join(`
`)),a=ou(a),a=Fm(a,e),a=Om(a,e),o=ou(o),o=Fm(o,e),o=Om(o,e),a=Bm(a),o=Bm(o),e.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,_=[u,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+_,p=["#define varying in",e.glslVersion===yn?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===yn?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+p);let M=g+_+a,A=g+p+o,b=Nm(s,s.VERTEX_SHADER,M),E=Nm(s,s.FRAGMENT_SHADER,A);s.attachShader(m,b),s.attachShader(m,E),e.index0AttributeName!==void 0?s.bindAttribLocation(m,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(m,0,"position"),s.linkProgram(m);function S(P){if(n.debug.checkShaderErrors){let D=s.getProgramInfoLog(m)||"",N=s.getShaderInfoLog(b)||"",V=s.getShaderInfoLog(E)||"",I=D.trim(),W=N.trim(),Y=V.trim(),G=!0,tt=!0;if(s.getProgramParameter(m,s.LINK_STATUS)===!1)if(G=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,m,b,E);else{let X=Um(s,b,"vertex"),j=Um(s,E,"fragment");Pt("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(m,s.VALIDATE_STATUS)+`

Material Name: `+P.name+`
Material Type: `+P.type+`

Program Info Log: `+I+`
`+X+`
`+j)}else I!==""?Rt("WebGLProgram: Program Info Log:",I):(W===""||Y==="")&&(tt=!1);tt&&(P.diagnostics={runnable:G,programLog:I,vertexShader:{log:W,prefix:_},fragmentShader:{log:Y,prefix:p}})}s.deleteShader(b),s.deleteShader(E),x=new Ks(s,m),w=RS(s,m)}let x;this.getUniforms=function(){return x===void 0&&S(this),x};let w;this.getAttributes=function(){return w===void 0&&S(this),w};let O=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return O===!1&&(O=s.getProgramParameter(m,yS)),O},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(m),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=vS++,this.cacheKey=t,this.usedTimes=1,this.program=m,this.vertexShader=b,this.fragmentShader=E,this}var VS=0,lu=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,i){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let i of e)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,i=e.get(t);return i===void 0&&(i=new Set,e.set(t,i)),i}_getShaderStage(t){let e=this.shaderCache,i=e.get(t);return i===void 0&&(i=new cu(t),e.set(t,i)),i}},cu=class{constructor(t){this.id=VS++,this.code=t,this.usedTimes=0}};function GS(n){return n===Ii||n===Yr||n===Zr}function HS(n,t,e,i,s,r){let a=new Ir,o=new lu,l=new Set,c=[],h=new Map,f=i.logarithmicDepthBuffer,u={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(x){return l.add(x),x===0?"uv":`uv${x}`}function m(x,w,O,P,D,N){let V=P.fog,I=D.geometry,W=x.isMeshStandardMaterial||x.isMeshLambertMaterial||x.isMeshPhongMaterial?P.environment:null,Y=x.isMeshStandardMaterial||x.isMeshLambertMaterial&&!x.envMap||x.isMeshPhongMaterial&&!x.envMap,G=t.get(x.envMap||W,Y),tt=u[x.type],X=i.precision;x.precision!==null&&(X=i.getMaxPrecision(x.precision),X!==x.precision&&Rt("WebGLProgram.getParameters:",x.precision,"not supported, using",X,"instead."));let j=I.morphAttributes.position||I.morphAttributes.normal||I.morphAttributes.color,et=j!==void 0?j.length:0,Mt=0;I.morphAttributes.position!==void 0&&(Mt=1),I.morphAttributes.normal!==void 0&&(Mt=2),I.morphAttributes.color!==void 0&&(Mt=3);let Dt,J,mt,yt;if(tt){let pt=Ze[tt];Dt=pt.vertexShader,J=pt.fragmentShader}else{Dt=x.vertexShader,J=x.fragmentShader;let pt=o.getVertexShaderStage(x),te=o.getFragmentShaderStage(x);o.update(x,pt,te),mt=pt.id,yt=te.id}let Et=n.getRenderTarget(),gt=n.state.buffers.depth.getReversed(),Ft=D.isInstancedMesh===!0,me=D.isBatchedMesh===!0,It=!!x.map,Qt=!!x.matcap,ee=!!G,Gt=ee&&G.isPMREMTexture===!0,Ce=!!x.aoMap,_e=!!x.lightMap,Je=!!x.bumpMap&&x.wireframe===!1,ce=!!x.normalMap,Pn=!!x.displacementMap,Se=!!x.emissiveMap,hn=!!x.metalnessMap,un=!!x.roughnessMap,fn=x.anisotropy>0,U=x.clearcoat>0,dn=x.diffuseRoughness>0,oe=x.dispersion>0,le=x.retroreflectivity>0,dt=x.iridescence>0,ye=x.sheen>0,Ct=x.transmission>0,Nt=fn&&!!x.anisotropyMap,T=U&&!!x.clearcoatMap,y=U&&!!x.clearcoatNormalMap,k=U&&!!x.clearcoatRoughnessMap,nt=dn&&!!x.diffuseRoughnessMap,Q=dt&&!!x.iridescenceMap,rt=dt&&!!x.iridescenceThicknessMap,ht=ye&&!!x.sheenColorMap,$=ye&&!!x.sheenRoughnessMap,Z=!!x.specularMap,ot=!!x.specularColorMap,R=!!x.specularIntensityMap,K=Ct&&!!x.transmissionMap,q=Ct&&!!x.thicknessMap,lt=!!x.gradientMap,st=!!x.alphaMap,at=x.alphaTest>0,wt=!!x.alphaHash,kt=!!x.extensions,it=Hn;x.toneMapped&&(Et===null||Et.isXRRenderTarget===!0)&&(it=n.toneMapping);let At=Gt?G.isCompressedCubeTexture?G.image[0].mipmaps:G.mipmaps:null,Bt={shaderID:tt,shaderType:x.type,shaderName:x.name,vertexShader:Dt,fragmentShader:J,defines:x.defines,customVertexShaderID:mt,customFragmentShaderID:yt,isRawShaderMaterial:x.isRawShaderMaterial===!0,glslVersion:x.glslVersion,precision:X,batching:me,batchingColor:me&&D._colorsTexture!==null,instancing:Ft,instancingColor:Ft&&D.instanceColor!==null,instancingMorph:Ft&&D.morphTexture!==null,outputColorSpace:Et===null?n.outputColorSpace:Et.isXRRenderTarget===!0?Et.texture.colorSpace:qt.workingColorSpace,alphaToCoverage:!!x.alphaToCoverage,map:It,matcap:Qt,envMap:ee,envMapMode:ee&&G.mapping,envMapPMREM:Gt,envMapMaxLod:Gt?At.length-1:null,envMapSize:Gt?At[0].width:null,aoMap:Ce,lightMap:_e,bumpMap:Je,normalMap:ce,displacementMap:Pn,emissiveMap:Se,normalMapObjectSpace:ce&&x.normalMapType===cm,normalMapTangentSpace:ce&&x.normalMapType===Hh,packedNormalMap:ce&&x.normalMapType===Hh&&GS(x.normalMap.format),metalnessMap:hn,roughnessMap:un,anisotropy:fn,anisotropyMap:Nt,clearcoat:U,clearcoatMap:T,clearcoatNormalMap:y,clearcoatRoughnessMap:k,diffuseRoughness:dn,diffuseRoughnessMap:nt,dispersion:oe,retroreflection:le,iridescence:dt,iridescenceMap:Q,iridescenceThicknessMap:rt,sheen:ye,sheenColorMap:ht,sheenRoughnessMap:$,specularMap:Z,specularColorMap:ot,specularIntensityMap:R,transmission:Ct,transmissionMap:K,thicknessMap:q,gradientMap:lt,opaque:x.transparent===!1&&x.blending===Ys&&x.alphaToCoverage===!1,alphaMap:st,alphaTest:at,alphaHash:wt,combine:x.combine,mapUv:It&&d(x.map.channel),aoMapUv:Ce&&d(x.aoMap.channel),lightMapUv:_e&&d(x.lightMap.channel),bumpMapUv:Je&&d(x.bumpMap.channel),normalMapUv:ce&&d(x.normalMap.channel),displacementMapUv:Pn&&d(x.displacementMap.channel),emissiveMapUv:Se&&d(x.emissiveMap.channel),metalnessMapUv:hn&&d(x.metalnessMap.channel),roughnessMapUv:un&&d(x.roughnessMap.channel),anisotropyMapUv:Nt&&d(x.anisotropyMap.channel),clearcoatMapUv:T&&d(x.clearcoatMap.channel),clearcoatNormalMapUv:y&&d(x.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:k&&d(x.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:nt&&d(x.diffuseRoughnessMap.channel),iridescenceMapUv:Q&&d(x.iridescenceMap.channel),iridescenceThicknessMapUv:rt&&d(x.iridescenceThicknessMap.channel),sheenColorMapUv:ht&&d(x.sheenColorMap.channel),sheenRoughnessMapUv:$&&d(x.sheenRoughnessMap.channel),specularMapUv:Z&&d(x.specularMap.channel),specularColorMapUv:ot&&d(x.specularColorMap.channel),specularIntensityMapUv:R&&d(x.specularIntensityMap.channel),transmissionMapUv:K&&d(x.transmissionMap.channel),thicknessMapUv:q&&d(x.thicknessMap.channel),alphaMapUv:st&&d(x.alphaMap.channel),vertexTangents:!!I.attributes.tangent&&(ce||fn),vertexNormals:!!I.attributes.normal,vertexColors:x.vertexColors,vertexAlphas:x.vertexColors===!0&&!!I.attributes.color&&I.attributes.color.itemSize===4,pointsUvs:D.isPoints===!0&&!!I.attributes.uv&&(It||st),fog:!!V,useFog:x.fog===!0,fogExp2:!!V&&V.isFogExp2,flatShading:x.wireframe===!1&&(x.flatShading===!0||I.attributes.normal===void 0&&ce===!1&&(x.isMeshLambertMaterial||x.isMeshPhongMaterial||x.isMeshStandardMaterial||x.isMeshPhysicalMaterial)),sizeAttenuation:x.sizeAttenuation===!0,logarithmicDepthBuffer:f,reversedDepthBuffer:gt,skinning:D.isSkinnedMesh===!0,hasPositionAttribute:I.attributes.position!==void 0,morphTargets:I.morphAttributes.position!==void 0,morphNormals:I.morphAttributes.normal!==void 0,morphColors:I.morphAttributes.color!==void 0,morphTargetsCount:et,morphTextureStride:Mt,numSunLights:w.sun.length,numDirLights:w.directional.length,numPointLights:w.point.length,numSpotLights:w.spot.length,numSpotLightMaps:w.spotLightMap.length,numRectAreaLights:w.rectArea.length,numHemiLights:w.hemi.length,numSunLightShadows:w.sunShadowMap.length,numDirLightShadows:w.directionalShadowMap.length,numPointLightShadows:w.pointShadowMap.length,numSpotLightShadows:w.spotShadowMap.length,numSpotLightShadowsWithMaps:w.numSpotLightShadowsWithMaps,numLightProbes:w.numLightProbes,numLightProbeGrids:N.filter(pt=>pt.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:x.dithering,shadowMapEnabled:n.shadowMap.enabled&&O.length>0,shadowMapType:n.shadowMap.type,toneMapping:it,decodeVideoTexture:It&&x.map.isVideoTexture===!0&&qt.getTransfer(x.map.colorSpace)===jt,decodeVideoTextureEmissive:Se&&x.emissiveMap.isVideoTexture===!0&&qt.getTransfer(x.emissiveMap.colorSpace)===jt,premultipliedAlpha:x.premultipliedAlpha,doubleSided:x.side===Pe,flipSided:x.side===qe,useDepthPacking:x.depthPacking>=0,depthPacking:x.depthPacking||0,index0AttributeName:x.index0AttributeName,extensionClipCullDistance:kt&&x.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(kt&&x.extensions.multiDraw===!0||me)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:x.customProgramCacheKey()};return Bt.vertexUv1s=l.has(1),Bt.vertexUv2s=l.has(2),Bt.vertexUv3s=l.has(3),l.clear(),Bt}function _(x){let w=[];if(x.shaderID?w.push(x.shaderID):(w.push(x.customVertexShaderID),w.push(x.customFragmentShaderID)),x.defines!==void 0)for(let O in x.defines)w.push(O),w.push(x.defines[O]);return x.isRawShaderMaterial===!1&&(p(w,x),g(w,x),w.push(n.outputColorSpace)),w.push(x.customProgramCacheKey),w.join()}function p(x,w){x.push(w.precision),x.push(w.outputColorSpace),x.push(w.envMapMode),x.push(w.envMapPMREM),x.push(w.envMapMaxLod),x.push(w.envMapSize),x.push(w.mapUv),x.push(w.alphaMapUv),x.push(w.lightMapUv),x.push(w.aoMapUv),x.push(w.bumpMapUv),x.push(w.normalMapUv),x.push(w.displacementMapUv),x.push(w.emissiveMapUv),x.push(w.metalnessMapUv),x.push(w.roughnessMapUv),x.push(w.anisotropyMapUv),x.push(w.clearcoatMapUv),x.push(w.clearcoatNormalMapUv),x.push(w.clearcoatRoughnessMapUv),x.push(w.diffuseRoughnessMapUv),x.push(w.iridescenceMapUv),x.push(w.iridescenceThicknessMapUv),x.push(w.sheenColorMapUv),x.push(w.sheenRoughnessMapUv),x.push(w.specularMapUv),x.push(w.specularColorMapUv),x.push(w.specularIntensityMapUv),x.push(w.transmissionMapUv),x.push(w.thicknessMapUv),x.push(w.combine),x.push(w.fogExp2),x.push(w.sizeAttenuation),x.push(w.morphTargetsCount),x.push(w.numSunLights),x.push(w.numDirLights),x.push(w.numPointLights),x.push(w.numSpotLights),x.push(w.numSpotLightMaps),x.push(w.numHemiLights),x.push(w.numRectAreaLights),x.push(w.numSunLightShadows),x.push(w.numDirLightShadows),x.push(w.numPointLightShadows),x.push(w.numSpotLightShadows),x.push(w.numSpotLightShadowsWithMaps),x.push(w.numLightProbes),x.push(w.numLightProbeGrids),x.push(w.shadowMapType),x.push(w.toneMapping),x.push(w.numClippingPlanes),x.push(w.numClipIntersection),x.push(w.depthPacking)}function g(x,w){a.disableAll(),w.instancing&&a.enable(0),w.instancingColor&&a.enable(1),w.instancingMorph&&a.enable(2),w.matcap&&a.enable(3),w.envMap&&a.enable(4),w.normalMapObjectSpace&&a.enable(5),w.normalMapTangentSpace&&a.enable(6),w.clearcoat&&a.enable(7),w.iridescence&&a.enable(8),w.alphaTest&&a.enable(9),w.vertexColors&&a.enable(10),w.vertexAlphas&&a.enable(11),w.vertexUv1s&&a.enable(12),w.vertexUv2s&&a.enable(13),w.vertexUv3s&&a.enable(14),w.vertexTangents&&a.enable(15),w.anisotropy&&a.enable(16),w.alphaHash&&a.enable(17),w.batching&&a.enable(18),w.dispersion&&a.enable(19),w.retroreflection&&a.enable(24),w.diffuseRoughness&&a.enable(25),w.batchingColor&&a.enable(20),w.gradientMap&&a.enable(21),w.packedNormalMap&&a.enable(22),w.vertexNormals&&a.enable(23),x.push(a.mask),a.disableAll(),w.fog&&a.enable(0),w.useFog&&a.enable(1),w.flatShading&&a.enable(2),w.logarithmicDepthBuffer&&a.enable(3),w.reversedDepthBuffer&&a.enable(4),w.skinning&&a.enable(5),w.morphTargets&&a.enable(6),w.morphNormals&&a.enable(7),w.morphColors&&a.enable(8),w.premultipliedAlpha&&a.enable(9),w.shadowMapEnabled&&a.enable(10),w.doubleSided&&a.enable(11),w.flipSided&&a.enable(12),w.useDepthPacking&&a.enable(13),w.dithering&&a.enable(14),w.transmission&&a.enable(15),w.sheen&&a.enable(16),w.opaque&&a.enable(17),w.pointsUvs&&a.enable(18),w.decodeVideoTexture&&a.enable(19),w.decodeVideoTextureEmissive&&a.enable(20),w.alphaToCoverage&&a.enable(21),w.numLightProbeGrids>0&&a.enable(22),w.hasPositionAttribute&&a.enable(23),x.push(a.mask)}function M(x){let w=u[x.type],O;if(w){let P=Ze[w];O=jr.clone(P.uniforms)}else O=x.uniforms;return O}function A(x,w){let O=h.get(w);return O!==void 0?++O.usedTimes:(O=new zS(n,w,x,s),c.push(O),h.set(w,O)),O}function b(x){if(--x.usedTimes===0){let w=c.indexOf(x);c[w]=c[c.length-1],c.pop(),h.delete(x.cacheKey),x.destroy()}}function E(x){o.remove(x)}function S(){o.dispose()}return{getParameters:m,getProgramCacheKey:_,getUniforms:M,acquireProgram:A,releaseProgram:b,releaseShaderCache:E,programs:c,dispose:S}}function WS(){let n=new WeakMap;function t(a){return n.has(a)}function e(a){let o=n.get(a);return o===void 0&&(o={},n.set(a,o)),o}function i(a){n.delete(a)}function s(a,o,l){n.get(a)[o]=l}function r(){n=new WeakMap}return{has:t,get:e,remove:i,update:s,dispose:r}}function XS(n,t){return n.groupOrder!==t.groupOrder?n.groupOrder-t.groupOrder:n.renderOrder!==t.renderOrder?n.renderOrder-t.renderOrder:n.material.id!==t.material.id?n.material.id-t.material.id:n.materialVariant!==t.materialVariant?n.materialVariant-t.materialVariant:n.z!==t.z?n.z-t.z:n.id-t.id}function zm(n,t){return n.groupOrder!==t.groupOrder?n.groupOrder-t.groupOrder:n.renderOrder!==t.renderOrder?n.renderOrder-t.renderOrder:n.z!==t.z?t.z-n.z:n.id-t.id}function Vm(){let n=[],t=0,e=[],i=[],s=[];function r(){t=0,e.length=0,i.length=0,s.length=0}function a(u){let d=0;return u.isInstancedMesh&&(d+=2),u.isSkinnedMesh&&(d+=1),d}function o(u,d,m,_,p,g){let M=n[t];return M===void 0?(M={id:u.id,object:u,geometry:d,material:m,materialVariant:a(u),groupOrder:_,renderOrder:u.renderOrder,z:p,group:g},n[t]=M):(M.id=u.id,M.object=u,M.geometry=d,M.material=m,M.materialVariant=a(u),M.groupOrder=_,M.renderOrder=u.renderOrder,M.z=p,M.group=g),t++,M}function l(u,d,m,_,p,g,M){M.reversedDepth===!0&&(p=-p);let A=o(u,d,m,_,p,g);m.transmission>0?i.push(A):m.transparent===!0?s.push(A):e.push(A)}function c(u,d,m,_,p,g){let M=o(u,d,m,_,p,g);m.transmission>0?i.unshift(M):m.transparent===!0?s.unshift(M):e.unshift(M)}function h(u,d){e.length>1&&e.sort(u||XS),i.length>1&&i.sort(d||zm),s.length>1&&s.sort(d||zm)}function f(){for(let u=t,d=n.length;u<d;u++){let m=n[u];if(m.id===null)break;m.id=null,m.object=null,m.geometry=null,m.material=null,m.group=null}}return{opaque:e,transmissive:i,transparent:s,init:r,push:l,unshift:c,finish:f,sort:h}}function qS(){let n=new WeakMap;function t(i,s){let r=n.get(i),a;return r===void 0?(a=new Vm,n.set(i,[a])):s>=r.length?(a=new Vm,r.push(a)):a=r[s],a}function e(){n=new WeakMap}return{get:t,dispose:e}}function $S(){let n={};return{get:function(t){if(n[t.id]!==void 0)return n[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new F,color:new Yt};break;case"SpotLight":e={position:new F,direction:new F,color:new Yt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new F,color:new Yt,distance:0,decay:0};break;case"HemisphereLight":e={direction:new F,skyColor:new Yt,groundColor:new Yt};break;case"RectAreaLight":e={color:new Yt,position:new F,halfWidth:new F,halfHeight:new F};break}return n[t.id]=e,e}}}function YS(){let n={};return{get:function(t){if(n[t.id]!==void 0)return n[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $t};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $t};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $t,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[t.id]=e,e}}}var ZS=0;function JS(n,t){return(t.castShadow?2:0)-(n.castShadow?2:0)+(t.map?1:0)-(n.map?1:0)}function KS(n){let t=new $S,e=YS(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)i.probe.push(new F);let s=new F,r=new ie,a=new ie;function o(c){let h=0,f=0,u=0;for(let N=0;N<9;N++)i.probe[N].set(0,0,0);let d=0,m=0,_=0,p=0,g=0,M=0,A=0,b=0,E=0,S=0,x=0,w=0,O=0,P=0;c.sort(JS);for(let N=0,V=c.length;N<V;N++){let I=c[N],W=I.color,Y=I.intensity,G=I.distance,tt=null;if(I.shadow&&I.shadow.map&&(I.shadow.map.texture.format===Ii?tt=I.shadow.map.texture:tt=I.shadow.map.depthTexture||I.shadow.map.texture),I.isAmbientLight)h+=W.r*Y,f+=W.g*Y,u+=W.b*Y;else if(I.isLightProbe){for(let X=0;X<9;X++)i.probe[X].addScaledVector(I.sh.coefficients[X],Y);P++}else if(I.isSunLight){let X=t.get(I);if(X.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let j=I.shadow,et=e.get(I);et.shadowIntensity=j.intensity,et.shadowBias=j.bias,et.shadowNormalBias=j.normalBias,et.shadowRadius=j.radius,et.shadowMapSize.copy(j.mapSize).multiply(j.getFrameExtents()),i.sunShadow[m]=et,i.sunShadowMap[m]=tt;let Mt=j.getViewportCount();for(let Dt=0;Dt<Mt;Dt++)i.sunShadowMatrix[_+Dt]=j.getMatrix(Dt),i.sunShadowCascade[_+Dt]=j._cascadeData[Dt];_+=Mt,m++}i.sun[d]=X,d++}else if(I.isDirectionalLight){let X=t.get(I);if(X.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let j=I.shadow,et=e.get(I);et.shadowIntensity=j.intensity,et.shadowBias=j.bias,et.shadowNormalBias=j.normalBias,et.shadowRadius=j.radius,et.shadowMapSize=j.mapSize,i.directionalShadow[p]=et,i.directionalShadowMap[p]=tt,i.directionalShadowMatrix[p]=I.shadow.matrix,E++}i.directional[p]=X,p++}else if(I.isSpotLight){let X=t.get(I);X.position.setFromMatrixPosition(I.matrixWorld),X.color.copy(W).multiplyScalar(Y),X.distance=G,X.coneCos=Math.cos(I.angle),X.penumbraCos=Math.cos(I.angle*(1-I.penumbra)),X.decay=I.decay,i.spot[M]=X;let j=I.shadow;if(I.map&&(i.spotLightMap[w]=I.map,w++,j.updateMatrices(I),I.castShadow&&O++),i.spotLightMatrix[M]=j.matrix,I.castShadow){let et=e.get(I);et.shadowIntensity=j.intensity,et.shadowBias=j.bias,et.shadowNormalBias=j.normalBias,et.shadowRadius=j.radius,et.shadowMapSize=j.mapSize,i.spotShadow[M]=et,i.spotShadowMap[M]=tt,x++}M++}else if(I.isRectAreaLight){let X=t.get(I);X.color.copy(W).multiplyScalar(Y),X.halfWidth.set(I.width*.5,0,0),X.halfHeight.set(0,I.height*.5,0),i.rectArea[A]=X,A++}else if(I.isPointLight){let X=t.get(I);if(X.color.copy(I.color).multiplyScalar(I.intensity),X.distance=I.distance,X.decay=I.decay,I.castShadow){let j=I.shadow,et=e.get(I);et.shadowIntensity=j.intensity,et.shadowBias=j.bias,et.shadowNormalBias=j.normalBias,et.shadowRadius=j.radius,et.shadowMapSize=j.mapSize,et.shadowCameraNear=j.camera.near,et.shadowCameraFar=j.camera.far,i.pointShadow[g]=et,i.pointShadowMap[g]=tt,i.pointShadowMatrix[g]=I.shadow.matrix,S++}i.point[g]=X,g++}else if(I.isHemisphereLight){let X=t.get(I);X.skyColor.copy(I.color).multiplyScalar(Y),X.groundColor.copy(I.groundColor).multiplyScalar(Y),i.hemi[b]=X,b++}}A>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=ft.LTC_FLOAT_1,i.rectAreaLTC2=ft.LTC_FLOAT_2):(i.rectAreaLTC1=ft.LTC_HALF_1,i.rectAreaLTC2=ft.LTC_HALF_2)),i.ambient[0]=h,i.ambient[1]=f,i.ambient[2]=u;let D=i.hash;(D.sunLength!==d||D.directionalLength!==p||D.pointLength!==g||D.spotLength!==M||D.rectAreaLength!==A||D.hemiLength!==b||D.numSunShadows!==m||D.numDirectionalShadows!==E||D.numPointShadows!==S||D.numSpotShadows!==x||D.numSpotMaps!==w||D.numLightProbes!==P)&&(i.sun.length=d,i.directional.length=p,i.spot.length=M,i.rectArea.length=A,i.point.length=g,i.hemi.length=b,i.sunShadow.length=m,i.sunShadowMap.length=m,i.sunShadowMatrix.length=_,i.sunShadowCascade.length=_,i.directionalShadow.length=E,i.directionalShadowMap.length=E,i.directionalShadowMatrix.length=E,i.pointShadow.length=S,i.pointShadowMap.length=S,i.pointShadowMatrix.length=S,i.spotShadow.length=x,i.spotShadowMap.length=x,i.spotLightMatrix.length=x+w-O,i.spotLightMap.length=w,i.numSpotLightShadowsWithMaps=O,i.numLightProbes=P,D.sunLength=d,D.directionalLength=p,D.pointLength=g,D.spotLength=M,D.rectAreaLength=A,D.hemiLength=b,D.numSunShadows=m,D.numDirectionalShadows=E,D.numPointShadows=S,D.numSpotShadows=x,D.numSpotMaps=w,D.numLightProbes=P,i.version=ZS++)}function l(c,h){let f=0,u=0,d=0,m=0,_=0,p=0,g=h.matrixWorldInverse;for(let M=0,A=c.length;M<A;M++){let b=c[M];if(b.isSunLight){let E=i.sun[f];E.direction.setFromMatrixPosition(b.matrixWorld),E.direction.transformDirection(g),f++}else if(b.isDirectionalLight){let E=i.directional[u];E.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),E.direction.sub(s),E.direction.transformDirection(g),u++}else if(b.isSpotLight){let E=i.spot[m];E.position.setFromMatrixPosition(b.matrixWorld),E.position.applyMatrix4(g),E.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),E.direction.sub(s),E.direction.transformDirection(g),m++}else if(b.isRectAreaLight){let E=i.rectArea[_];E.position.setFromMatrixPosition(b.matrixWorld),E.position.applyMatrix4(g),a.identity(),r.copy(b.matrixWorld),r.premultiply(g),a.extractRotation(r),E.halfWidth.set(b.width*.5,0,0),E.halfHeight.set(0,b.height*.5,0),E.halfWidth.applyMatrix4(a),E.halfHeight.applyMatrix4(a),_++}else if(b.isPointLight){let E=i.point[d];E.position.setFromMatrixPosition(b.matrixWorld),E.position.applyMatrix4(g),d++}else if(b.isHemisphereLight){let E=i.hemi[p];E.direction.setFromMatrixPosition(b.matrixWorld),E.direction.transformDirection(g),p++}}}return{setup:o,setupView:l,state:i}}function Gm(n){let t=new KS(n),e=[],i=[],s=[];function r(f){h.camera=f,e.length=0,i.length=0,s.length=0}function a(f){f.isLightProbeGrid?s.push(f):e.push(f)}function o(f){i.push(f)}function l(){t.setup(e),s.sort((f,u)=>f.priority-u.priority||f.id-u.id)}function c(f){t.setupView(e,f)}let h={lightsArray:e,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:a,pushShadow:o}}function jS(n){let t=new WeakMap;function e(s,r=0){let a=t.get(s),o;return a===void 0?(o=new Gm(n),t.set(s,[o])):r>=a.length?(o=new Gm(n),a.push(o)):o=a[r],o}function i(){t=new WeakMap}return{get:e,dispose:i}}var QS=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,t1=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,e1=[new F(1,0,0),new F(-1,0,0),new F(0,1,0),new F(0,-1,0),new F(0,0,1),new F(0,0,-1)],n1=[new F(0,-1,0),new F(0,-1,0),new F(0,0,1),new F(0,0,-1),new F(0,-1,0),new F(0,-1,0)],Hm=new ie,Qr=new F,iu=new F;function i1(n,t,e){let i=new Ji,s=new $t,r=new $t,a=new Kt,o=new Oo,l=new Bo,c={},h=e.maxTextureSize,f={[Ri]:qe,[qe]:Ri,[Pe]:Pe},u=new pe({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new $t},radius:{value:4}},vertexShader:QS,fragmentShader:t1}),d=u.clone();d.defines.HORIZONTAL_PASS=1;let m=new ve;m.setAttribute("position",new re(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let _=new de(m,u),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Gr;let g=this.type;this.render=function(S,x,w){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||S.length===0)return;this.type===zp&&(Rt("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Gr);let O=n.getRenderTarget(),P=n.getActiveCubeFace(),D=n.getActiveMipmapLevel(),N=n.state;N.setBlending(ji),N.buffers.depth.getReversed()===!0?N.buffers.color.setClear(0,0,0,0):N.buffers.color.setClear(1,1,1,1),N.buffers.depth.setTest(!0),N.setScissorTest(!1);let V=g!==this.type;V&&x.traverse(function(I){I.material&&(Array.isArray(I.material)?I.material.forEach(W=>W.needsUpdate=!0):I.material.needsUpdate=!0)});for(let I=0,W=S.length;I<W;I++){let Y=S[I],G=Y.shadow;if(G===void 0){Rt("WebGLShadowMap:",Y,"has no shadow.");continue}if(G.autoUpdate===!1&&G.needsUpdate===!1)continue;s.copy(G.mapSize);let tt=G.getFrameExtents();s.multiply(tt),r.copy(G.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/tt.x),s.x=r.x*tt.x,G.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/tt.y),s.y=r.y*tt.y,G.mapSize.y=r.y));let X=n.state.buffers.depth.getReversed();if(G.camera._reversedDepth=X,G.map===null||V===!0){if(G.map!==null&&(G.map.depthTexture!==null&&(G.map.depthTexture.dispose(),G.map.depthTexture=null),G.map.dispose()),this.type===$s){if(Y.isPointLight){Rt("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}G.map=new Ie(s.x,s.y,{format:Ii,type:In,minFilter:fe,magFilter:fe,generateMipmaps:!1}),G.map.texture.name=Y.name+".shadowMap",G.map.depthTexture=new on(s.x,s.y,Rn),G.map.depthTexture.name=Y.name+".shadowMapDepth",G.map.depthTexture.format=ii,G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=ue,G.map.depthTexture.magFilter=ue}else Y.isPointLight?(G.map=new ea(s.x),G.map.depthTexture=new Ur(s.x,Ye)):(G.map=new Ie(s.x,s.y),G.map.depthTexture=new on(s.x,s.y,Ye)),G.map.depthTexture.name=Y.name+".shadowMap",G.map.depthTexture.format=ii,this.type===Gr?(G.map.depthTexture.compareFunction=X?Wh:Jr,G.map.depthTexture.minFilter=fe,G.map.depthTexture.magFilter=fe):(G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=ue,G.map.depthTexture.magFilter=ue);G.camera.updateProjectionMatrix()}G.map.isWebGLCubeRenderTarget!==!0&&(G.map.width!==s.x||G.map.height!==s.y)&&G.map.setSize(s.x,s.y);let j=G.map.isWebGLCubeRenderTarget?6:G.getViewportCount();Y.isPointLight!==!0&&G.updateMatrices(Y,w);let et=(G.camera.layers.mask&4294967294)!==0?G.camera.layers:w.layers;for(let Mt=0;Mt<j;Mt++){let Dt=G.getCamera(Mt);if(Y.isPointLight){let J=G.camera,mt=G.matrix,yt=Y.distance||J.far;yt!==J.far&&(J.far=yt,J.updateProjectionMatrix()),Qr.setFromMatrixPosition(Y.matrixWorld),J.position.copy(Qr),iu.copy(J.position),iu.add(e1[Mt]),J.up.copy(n1[Mt]),J.lookAt(iu),J.updateMatrixWorld(),mt.makeTranslation(-Qr.x,-Qr.y,-Qr.z),Hm.multiplyMatrices(J.projectionMatrix,J.matrixWorldInverse),G._frustum.setFromProjectionMatrix(Hm,J.coordinateSystem,J.reversedDepth)}if(G.map.isWebGLCubeRenderTarget)n.setRenderTarget(G.map,Mt),n.clear();else{Mt===0&&(n.setRenderTarget(G.map),n.clear());let J=G.getViewport(Mt);a.set(r.x*J.x,r.y*J.y,r.x*J.z,r.y*J.w),N.viewport(a)}i=G.getFrustum(Mt),b(x,w,Dt,Y,et,this.type)}G.isPointLightShadow!==!0&&this.type===$s&&M(G,w),G.needsUpdate=!1}g=this.type,p.needsUpdate=!1,n.setRenderTarget(O,P,D)};function M(S,x){let w=t.update(_);u.defines.VSM_SAMPLES!==S.blurSamples&&(u.defines.VSM_SAMPLES=S.blurSamples,d.defines.VSM_SAMPLES=S.blurSamples,u.needsUpdate=!0,d.needsUpdate=!0),S.mapPass===null?S.mapPass=new Ie(s.x,s.y,{format:Ii,type:In}):(S.mapPass.width!==S.map.width||S.mapPass.height!==S.map.height)&&S.mapPass.setSize(S.map.width,S.map.height),u.uniforms.shadow_pass.value=S.map.depthTexture,u.uniforms.resolution.value.set(S.map.width,S.map.height),u.uniforms.radius.value=S.radius,n.setRenderTarget(S.mapPass),n.clear(),n.renderBufferDirect(x,null,w,u,_,null),d.uniforms.shadow_pass.value=S.mapPass.texture,d.uniforms.resolution.value.set(S.map.width,S.map.height),d.uniforms.radius.value=S.radius,n.setRenderTarget(S.map),n.clear(),n.renderBufferDirect(x,null,w,d,_,null)}function A(S,x,w,O){let P=null,D=w.isPointLight===!0?S.customDistanceMaterial:S.customDepthMaterial;if(D!==void 0)P=D;else if(P=w.isPointLight===!0?l:o,n.localClippingEnabled&&x.clipShadows===!0&&Array.isArray(x.clippingPlanes)&&x.clippingPlanes.length!==0||x.displacementMap&&x.displacementScale!==0||x.alphaMap&&x.alphaTest>0||x.map&&x.alphaTest>0||x.alphaToCoverage===!0){let N=P.uuid,V=x.uuid,I=c[N];I===void 0&&(I={},c[N]=I);let W=I[V];W===void 0&&(W=P.clone(),I[V]=W,x.addEventListener("dispose",E)),P=W}if(P.visible=x.visible,P.wireframe=x.wireframe,O===$s?P.side=x.shadowSide!==null?x.shadowSide:x.side:P.side=x.shadowSide!==null?x.shadowSide:f[x.side],P.alphaMap=x.alphaMap,P.alphaTest=x.alphaToCoverage===!0?.5:x.alphaTest,P.map=x.map,P.clipShadows=x.clipShadows,P.clippingPlanes=x.clippingPlanes,P.clipIntersection=x.clipIntersection,P.displacementMap=x.displacementMap,P.displacementScale=x.displacementScale,P.displacementBias=x.displacementBias,P.wireframeLinewidth=x.wireframeLinewidth,P.linewidth=x.linewidth,w.isPointLight===!0&&P.isMeshDistanceMaterial===!0){let N=n.properties.get(P);N.light=w}return P}function b(S,x,w,O,P,D){if(S.visible===!1)return;if(S.layers.test(P)&&(S.isMesh||S.isLine||S.isPoints)&&(S.castShadow||S.receiveShadow&&D===$s)&&(!S.frustumCulled||S.intersectsFrustum(i))){S.modelViewMatrix.multiplyMatrices(w.matrixWorldInverse,S.matrixWorld);let I=t.update(S),W=S.material;if(Array.isArray(W)){let Y=I.groups;for(let G=0,tt=Y.length;G<tt;G++){let X=Y[G],j=W[X.materialIndex];if(j&&j.visible){let et=A(S,j,O,D);S.onBeforeShadow(n,S,x,w,I,et,X),n.renderBufferDirect(w,null,I,et,S,X),S.onAfterShadow(n,S,x,w,I,et,X)}}}else if(W.visible){let Y=A(S,W,O,D);S.onBeforeShadow(n,S,x,w,I,Y,null),n.renderBufferDirect(w,null,I,Y,S,null),S.onAfterShadow(n,S,x,w,I,Y,null)}}let V=S.children;for(let I=0,W=V.length;I<W;I++)b(V[I],x,w,O,P,D)}function E(S){S.target.removeEventListener("dispose",E);for(let w in c){let O=c[w],P=S.target.uuid;P in O&&(O[P].dispose(),delete O[P])}}}function s1(n,t){function e(){let R=!1,K=new Kt,q=null,lt=new Kt(0,0,0,0);return{setMask:function(st){q!==st&&!R&&(n.colorMask(st,st,st,st),q=st)},setLocked:function(st){R=st},setClear:function(st,at,wt,kt,it){it===!0&&(st*=kt,at*=kt,wt*=kt),K.set(st,at,wt,kt),lt.equals(K)===!1&&(n.clearColor(st,at,wt,kt),lt.copy(K))},reset:function(){R=!1,q=null,lt.set(-1,0,0,0)}}}function i(){let R=!1,K=!1,q=null,lt=null,st=null;return{setReversed:function(at){if(K!==at){let wt=t.get("EXT_clip_control");at?wt.clipControlEXT(wt.LOWER_LEFT_EXT,wt.ZERO_TO_ONE_EXT):wt.clipControlEXT(wt.LOWER_LEFT_EXT,wt.NEGATIVE_ONE_TO_ONE_EXT),K=at;let kt=st;st=null,this.setClear(kt)}},getReversed:function(){return K},setTest:function(at){at?gt(n.DEPTH_TEST):Ft(n.DEPTH_TEST)},setMask:function(at){q!==at&&!R&&(n.depthMask(at),q=at)},setFunc:function(at){if(K&&(at=ym[at]),lt!==at){switch(at){case yo:n.depthFunc(n.NEVER);break;case vo:n.depthFunc(n.ALWAYS);break;case bo:n.depthFunc(n.LESS);break;case ks:n.depthFunc(n.LEQUAL);break;case Mo:n.depthFunc(n.EQUAL);break;case So:n.depthFunc(n.GEQUAL);break;case wo:n.depthFunc(n.GREATER);break;case Ao:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}lt=at}},setLocked:function(at){R=at},setClear:function(at){st!==at&&(st=at,K&&(at=1-at),n.clearDepth(at))},reset:function(){R=!1,q=null,lt=null,st=null,K=!1}}}function s(){let R=!1,K=null,q=null,lt=null,st=null,at=null,wt=null,kt=null,it=null;return{setTest:function(At){R||(At?gt(n.STENCIL_TEST):Ft(n.STENCIL_TEST))},setMask:function(At){K!==At&&!R&&(n.stencilMask(At),K=At)},setFunc:function(At,Bt,pt){(q!==At||lt!==Bt||st!==pt)&&(n.stencilFunc(At,Bt,pt),q=At,lt=Bt,st=pt)},setOp:function(At,Bt,pt){(at!==At||wt!==Bt||kt!==pt)&&(n.stencilOp(At,Bt,pt),at=At,wt=Bt,kt=pt)},setLocked:function(At){R=At},setClear:function(At){it!==At&&(n.clearStencil(At),it=At)},reset:function(){R=!1,K=null,q=null,lt=null,st=null,at=null,wt=null,kt=null,it=null}}}let r=new e,a=new i,o=new s,l={},c=new WeakMap,h={},f={},u={},d=new WeakMap,m=[],_=null,p=!1,g=null,M=null,A=null,b=null,E=null,S=null,x=null,w=new Yt(0,0,0),O=0,P=!1,D=null,N=null,V=null,I=null,W=null,Y=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),G=!1,tt=0,X=n.getParameter(n.VERSION);X.indexOf("WebGL")!==-1?(tt=parseFloat(/^WebGL (\d)/.exec(X)[1]),G=tt>=1):X.indexOf("OpenGL ES")!==-1&&(tt=parseFloat(/^OpenGL ES (\d)/.exec(X)[1]),G=tt>=2);let j=null,et={},Mt=n.getParameter(n.SCISSOR_BOX),Dt=n.getParameter(n.VIEWPORT),J=new Kt().fromArray(Mt),mt=new Kt().fromArray(Dt);function yt(R,K,q,lt){let st=new Uint8Array(4),at=n.createTexture();n.bindTexture(R,at),n.texParameteri(R,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(R,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let wt=0;wt<q;wt++)R===n.TEXTURE_3D||R===n.TEXTURE_2D_ARRAY?n.texImage3D(K,0,n.RGBA,1,1,lt,0,n.RGBA,n.UNSIGNED_BYTE,st):n.texImage2D(K+wt,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,st);return at}let Et={};Et[n.TEXTURE_2D]=yt(n.TEXTURE_2D,n.TEXTURE_2D,1),Et[n.TEXTURE_CUBE_MAP]=yt(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),Et[n.TEXTURE_2D_ARRAY]=yt(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),Et[n.TEXTURE_3D]=yt(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),a.setClear(1),o.setClear(0),gt(n.DEPTH_TEST),a.setFunc(ks),Je(!1),ce(bh),gt(n.CULL_FACE),Ce(ji);function gt(R){h[R]!==!0&&(n.enable(R),h[R]=!0)}function Ft(R){h[R]!==!1&&(n.disable(R),h[R]=!1)}function me(R,K){return u[R]!==K?(n.bindFramebuffer(R,K),u[R]=K,R===n.DRAW_FRAMEBUFFER&&(u[n.FRAMEBUFFER]=K),R===n.FRAMEBUFFER&&(u[n.DRAW_FRAMEBUFFER]=K),!0):!1}function It(R,K){let q=m,lt=!1;if(R){q=d.get(K),q===void 0&&(q=[],d.set(K,q));let st=R.textures;if(q.length!==st.length||q[0]!==n.COLOR_ATTACHMENT0){for(let at=0,wt=st.length;at<wt;at++)q[at]=n.COLOR_ATTACHMENT0+at;q.length=st.length,lt=!0}}else q[0]!==n.BACK&&(q[0]=n.BACK,lt=!0);lt&&n.drawBuffers(q)}function Qt(R){return _!==R?(n.useProgram(R),_=R,!0):!1}let ee={[Qi]:n.FUNC_ADD,[Gp]:n.FUNC_SUBTRACT,[Hp]:n.FUNC_REVERSE_SUBTRACT};ee[Wp]=n.MIN,ee[Xp]=n.MAX;let Gt={[qp]:n.ZERO,[$p]:n.ONE,[Yp]:n.SRC_COLOR,[Ah]:n.SRC_ALPHA,[tm]:n.SRC_ALPHA_SATURATE,[jp]:n.DST_COLOR,[Jp]:n.DST_ALPHA,[Zp]:n.ONE_MINUS_SRC_COLOR,[Th]:n.ONE_MINUS_SRC_ALPHA,[Qp]:n.ONE_MINUS_DST_COLOR,[Kp]:n.ONE_MINUS_DST_ALPHA,[em]:n.CONSTANT_COLOR,[nm]:n.ONE_MINUS_CONSTANT_COLOR,[im]:n.CONSTANT_ALPHA,[sm]:n.ONE_MINUS_CONSTANT_ALPHA};function Ce(R,K,q,lt,st,at,wt,kt,it,At){if(R===ji){p===!0&&(Ft(n.BLEND),p=!1);return}if(p===!1&&(gt(n.BLEND),p=!0),R!==Vp){if(R!==g||At!==P){if((M!==Qi||E!==Qi)&&(n.blendEquation(n.FUNC_ADD),M=Qi,E=Qi),At)switch(R){case Ys:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Mh:n.blendFunc(n.ONE,n.ONE);break;case Sh:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case wh:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:Pt("WebGLState: Invalid blending: ",R);break}else switch(R){case Ys:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Mh:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case Sh:Pt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case wh:Pt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Pt("WebGLState: Invalid blending: ",R);break}A=null,b=null,S=null,x=null,w.set(0,0,0),O=0,g=R,P=At}return}st=st||K,at=at||q,wt=wt||lt,(K!==M||st!==E)&&(n.blendEquationSeparate(ee[K],ee[st]),M=K,E=st),(q!==A||lt!==b||at!==S||wt!==x)&&(n.blendFuncSeparate(Gt[q],Gt[lt],Gt[at],Gt[wt]),A=q,b=lt,S=at,x=wt),(kt.equals(w)===!1||it!==O)&&(n.blendColor(kt.r,kt.g,kt.b,it),w.copy(kt),O=it),g=R,P=!1}function _e(R,K){R.side===Pe?Ft(n.CULL_FACE):gt(n.CULL_FACE);let q=R.side===qe;K&&(q=!q),Je(q),R.blending===Ys&&R.transparent===!1?Ce(ji):Ce(R.blending,R.blendEquation,R.blendSrc,R.blendDst,R.blendEquationAlpha,R.blendSrcAlpha,R.blendDstAlpha,R.blendColor,R.blendAlpha,R.premultipliedAlpha),a.setFunc(R.depthFunc),a.setTest(R.depthTest),a.setMask(R.depthWrite),r.setMask(R.colorWrite);let lt=R.stencilWrite;o.setTest(lt),lt&&(o.setMask(R.stencilWriteMask),o.setFunc(R.stencilFunc,R.stencilRef,R.stencilFuncMask),o.setOp(R.stencilFail,R.stencilZFail,R.stencilZPass)),Se(R.polygonOffset,R.polygonOffsetFactor,R.polygonOffsetUnits),R.alphaToCoverage===!0?gt(n.SAMPLE_ALPHA_TO_COVERAGE):Ft(n.SAMPLE_ALPHA_TO_COVERAGE)}function Je(R){D!==R&&(R?n.frontFace(n.CW):n.frontFace(n.CCW),D=R)}function ce(R){R!==Bp?(gt(n.CULL_FACE),R!==N&&(R===bh?n.cullFace(n.BACK):R===kp?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):Ft(n.CULL_FACE),N=R}function Pn(R){R!==V&&(G&&n.lineWidth(R),V=R)}function Se(R,K,q){R?(gt(n.POLYGON_OFFSET_FILL),(I!==K||W!==q)&&(I=K,W=q,a.getReversed()&&(K=-K,q=-q),n.polygonOffset(K,q))):Ft(n.POLYGON_OFFSET_FILL)}function hn(R){R?gt(n.SCISSOR_TEST):Ft(n.SCISSOR_TEST)}function un(R){R===void 0&&(R=n.TEXTURE0+Y-1),j!==R&&(n.activeTexture(R),j=R)}function fn(R,K,q){q===void 0&&(j===null?q=n.TEXTURE0+Y-1:q=j);let lt=et[q];lt===void 0&&(lt={type:void 0,texture:void 0},et[q]=lt),(lt.type!==R||lt.texture!==K)&&(j!==q&&(n.activeTexture(q),j=q),n.bindTexture(R,K||Et[R]),lt.type=R,lt.texture=K)}function U(){let R=et[j];R!==void 0&&R.type!==void 0&&(n.bindTexture(R.type,null),R.type=void 0,R.texture=void 0)}function dn(){try{n.compressedTexImage2D(...arguments)}catch(R){Pt("WebGLState:",R)}}function oe(){try{n.compressedTexImage3D(...arguments)}catch(R){Pt("WebGLState:",R)}}function le(){try{n.texSubImage2D(...arguments)}catch(R){Pt("WebGLState:",R)}}function dt(){try{n.texSubImage3D(...arguments)}catch(R){Pt("WebGLState:",R)}}function ye(){try{n.compressedTexSubImage2D(...arguments)}catch(R){Pt("WebGLState:",R)}}function Ct(){try{n.compressedTexSubImage3D(...arguments)}catch(R){Pt("WebGLState:",R)}}function Nt(){try{n.texStorage2D(...arguments)}catch(R){Pt("WebGLState:",R)}}function T(){try{n.texStorage3D(...arguments)}catch(R){Pt("WebGLState:",R)}}function y(){try{n.texImage2D(...arguments)}catch(R){Pt("WebGLState:",R)}}function k(){try{n.texImage3D(...arguments)}catch(R){Pt("WebGLState:",R)}}function nt(R){return f[R]!==void 0?f[R]:n.getParameter(R)}function Q(R,K){f[R]!==K&&(n.pixelStorei(R,K),f[R]=K)}function rt(R){J.equals(R)===!1&&(n.scissor(R.x,R.y,R.z,R.w),J.copy(R))}function ht(R){mt.equals(R)===!1&&(n.viewport(R.x,R.y,R.z,R.w),mt.copy(R))}function $(R,K){let q=c.get(K);q===void 0&&(q=new WeakMap,c.set(K,q));let lt=q.get(R);lt===void 0&&(lt=n.getUniformBlockIndex(K,R.name),n.uniformBlockBinding(K,lt,lt),q.set(R,lt))}function Z(R,K,q){let st=c.get(K).get(R);l[st]!==q&&(n.bindBufferBase(n.UNIFORM_BUFFER,st,q),l[st]=q)}function ot(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),a.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),h={},f={},j=null,et={},u={},l={},d=new WeakMap,m=[],_=null,p=!1,g=null,M=null,A=null,b=null,E=null,S=null,x=null,w=new Yt(0,0,0),O=0,P=!1,D=null,N=null,V=null,I=null,W=null,J.set(0,0,n.canvas.width,n.canvas.height),mt.set(0,0,n.canvas.width,n.canvas.height),r.reset(),a.reset(),o.reset()}return{buffers:{color:r,depth:a,stencil:o},enable:gt,disable:Ft,bindFramebuffer:me,drawBuffers:It,useProgram:Qt,setBlending:Ce,setMaterial:_e,setFlipSided:Je,setCullFace:ce,setLineWidth:Pn,setPolygonOffset:Se,setScissorTest:hn,activeTexture:un,bindTexture:fn,unbindTexture:U,compressedTexImage2D:dn,compressedTexImage3D:oe,texImage2D:y,texImage3D:k,pixelStorei:Q,getParameter:nt,updateUBOMapping:$,uniformBlockBinding:Z,texStorage2D:Nt,texStorage3D:T,texSubImage2D:le,texSubImage3D:dt,compressedTexSubImage2D:ye,compressedTexSubImage3D:Ct,scissor:rt,viewport:ht,reset:ot}}function r1(n,t,e,i,s,r,a){let o=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new $t,h=new WeakMap,f=new Set,u,d=new WeakMap,m=new Set,_=new FinalizationRegistry(T=>m.delete(T)),p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(T,y){return p?new OffscreenCanvas(T,y):Er("canvas")}function M(T,y,k){let nt=1,Q=Nt(T);if((Q.width>k||Q.height>k)&&(nt=k/Math.max(Q.width,Q.height)),nt<1)if(typeof HTMLImageElement<"u"&&T instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&T instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&T instanceof ImageBitmap||typeof VideoFrame<"u"&&T instanceof VideoFrame){let rt=Math.floor(nt*Q.width),ht=Math.floor(nt*Q.height);u===void 0&&(u=g(rt,ht));let $=y?g(rt,ht):u;return $.width=rt,$.height=ht,$.getContext("2d").drawImage(T,0,0,rt,ht),Rt("WebGLRenderer: Texture has been resized from ("+Q.width+"x"+Q.height+") to ("+rt+"x"+ht+")."),$}else return"data"in T&&Rt("WebGLRenderer: Image in DataTexture is too big ("+Q.width+"x"+Q.height+")."),T;return T}function A(T){return T.generateMipmaps}function b(T){n.generateMipmap(T)}function E(T){return T.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:T.isWebGL3DRenderTarget?n.TEXTURE_3D:T.isWebGLArrayRenderTarget||T.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function S(T,y,k,nt,Q,rt=!1){if(T!==null){if(n[T]!==void 0)return n[T];Rt("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+T+"'")}let ht;nt&&(ht=t.get("EXT_texture_norm16"),ht||Rt("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let $=y;if(y===n.RED&&(k===n.FLOAT&&($=n.R32F),k===n.HALF_FLOAT&&($=n.R16F),k===n.UNSIGNED_BYTE&&($=n.R8),k===n.UNSIGNED_SHORT&&ht&&($=ht.R16_EXT),k===n.SHORT&&ht&&($=ht.R16_SNORM_EXT)),y===n.RED_INTEGER&&(k===n.UNSIGNED_BYTE&&($=n.R8UI),k===n.UNSIGNED_SHORT&&($=n.R16UI),k===n.UNSIGNED_INT&&($=n.R32UI),k===n.BYTE&&($=n.R8I),k===n.SHORT&&($=n.R16I),k===n.INT&&($=n.R32I)),y===n.RG&&(k===n.FLOAT&&($=n.RG32F),k===n.HALF_FLOAT&&($=n.RG16F),k===n.UNSIGNED_BYTE&&($=n.RG8),k===n.UNSIGNED_SHORT&&ht&&($=ht.RG16_EXT),k===n.SHORT&&ht&&($=ht.RG16_SNORM_EXT)),y===n.RG_INTEGER&&(k===n.UNSIGNED_BYTE&&($=n.RG8UI),k===n.UNSIGNED_SHORT&&($=n.RG16UI),k===n.UNSIGNED_INT&&($=n.RG32UI),k===n.BYTE&&($=n.RG8I),k===n.SHORT&&($=n.RG16I),k===n.INT&&($=n.RG32I)),y===n.RGB_INTEGER&&(k===n.UNSIGNED_BYTE&&($=n.RGB8UI),k===n.UNSIGNED_SHORT&&($=n.RGB16UI),k===n.UNSIGNED_INT&&($=n.RGB32UI),k===n.BYTE&&($=n.RGB8I),k===n.SHORT&&($=n.RGB16I),k===n.INT&&($=n.RGB32I)),y===n.RGBA_INTEGER&&(k===n.UNSIGNED_BYTE&&($=n.RGBA8UI),k===n.UNSIGNED_SHORT&&($=n.RGBA16UI),k===n.UNSIGNED_INT&&($=n.RGBA32UI),k===n.BYTE&&($=n.RGBA8I),k===n.SHORT&&($=n.RGBA16I),k===n.INT&&($=n.RGBA32I)),y===n.RGB&&(k===n.UNSIGNED_SHORT&&ht&&($=ht.RGB16_EXT),k===n.SHORT&&ht&&($=ht.RGB16_SNORM_EXT),k===n.UNSIGNED_INT_5_9_9_9_REV&&($=n.RGB9_E5),k===n.UNSIGNED_INT_10F_11F_11F_REV&&($=n.R11F_G11F_B10F)),y===n.RGBA){let Z=rt?Ar:qt.getTransfer(Q);k===n.FLOAT&&($=n.RGBA32F),k===n.HALF_FLOAT&&($=n.RGBA16F),k===n.UNSIGNED_BYTE&&($=Z===jt?n.SRGB8_ALPHA8:n.RGBA8),k===n.UNSIGNED_SHORT&&ht&&($=ht.RGBA16_EXT),k===n.SHORT&&ht&&($=ht.RGBA16_SNORM_EXT),k===n.UNSIGNED_SHORT_4_4_4_4&&($=n.RGBA4),k===n.UNSIGNED_SHORT_5_5_5_1&&($=n.RGB5_A1)}return($===n.R16F||$===n.R32F||$===n.RG16F||$===n.RG32F||$===n.RGBA16F||$===n.RGBA32F)&&t.get("EXT_color_buffer_float"),$}function x(T,y){let k;return T?y===null||y===Ye||y===es?k=n.DEPTH24_STENCIL8:y===Rn?k=n.DEPTH32F_STENCIL8:y===Js&&(k=n.DEPTH24_STENCIL8,Rt("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):y===null||y===Ye||y===es?k=n.DEPTH_COMPONENT24:y===Rn?k=n.DEPTH_COMPONENT32F:y===Js&&(k=n.DEPTH_COMPONENT16),k}function w(T,y){return A(T)===!0||T.isFramebufferTexture&&T.minFilter!==ue&&T.minFilter!==fe?Math.log2(Math.max(y.width,y.height))+1:T.mipmaps.length>0?T.mipmaps.length:T.isCompressedTexture&&Array.isArray(T.image)?y.mipmaps.length:1}function O(T){let y=new WeakRef(T);i.get(T).__ref=y,m.add(y),_.register(T,y,y)}function P(T){let y=i.get(T).__ref;y!==void 0&&(m.delete(y),_.unregister(y))}function D(T){V(T.target)}function N(T){I(T.target)}function V(T){T.removeEventListener("dispose",D),P(T),Y(T),T.isVideoTexture&&h.delete(T),T.isHTMLTexture&&f.delete(T)}function I(T){T.removeEventListener("dispose",N),P(T),tt(T)}function W(){for(let T of m){let y=T.deref();y!==void 0&&(y.isRenderTarget===!0?I(y):V(y))}m.clear(),f.clear()}function Y(T){let y=i.get(T);if(y.__webglInit===void 0)return;let k=T.source,nt=d.get(k);if(nt){let Q=nt[y.__cacheKey];Q.usedTimes--,Q.usedTimes===0&&G(T),Object.keys(nt).length===0&&d.delete(k)}i.remove(T)}function G(T){let y=i.get(T);n.deleteTexture(y.__webglTexture);let k=T.source,nt=d.get(k);delete nt[y.__cacheKey],a.memory.textures--}function tt(T){let y=i.get(T);y.__depthDisposeCallback&&y.__depthDisposeCallback();let k=T.depthTexture;if(k&&k.renderTarget===T&&V(k),T.isWebGLCubeRenderTarget)for(let Q=0;Q<6;Q++){if(Array.isArray(y.__webglFramebuffer[Q]))for(let rt=0;rt<y.__webglFramebuffer[Q].length;rt++)n.deleteFramebuffer(y.__webglFramebuffer[Q][rt]);else n.deleteFramebuffer(y.__webglFramebuffer[Q]);y.__webglDepthbuffer&&n.deleteRenderbuffer(y.__webglDepthbuffer[Q])}else{if(Array.isArray(y.__webglFramebuffer))for(let Q=0;Q<y.__webglFramebuffer.length;Q++)n.deleteFramebuffer(y.__webglFramebuffer[Q]);else n.deleteFramebuffer(y.__webglFramebuffer);if(y.__webglDepthbuffer&&n.deleteRenderbuffer(y.__webglDepthbuffer),y.__webglMultisampledFramebuffer&&n.deleteFramebuffer(y.__webglMultisampledFramebuffer),y.__webglColorRenderbuffer)for(let Q=0;Q<y.__webglColorRenderbuffer.length;Q++)y.__webglColorRenderbuffer[Q]&&n.deleteRenderbuffer(y.__webglColorRenderbuffer[Q]);y.__webglDepthRenderbuffer&&n.deleteRenderbuffer(y.__webglDepthRenderbuffer)}let nt=T.textures;for(let Q=0,rt=nt.length;Q<rt;Q++){let ht=i.get(nt[Q]);ht.__webglTexture&&(n.deleteTexture(ht.__webglTexture),a.memory.textures--),i.remove(nt[Q])}i.remove(T)}let X=0;function j(){X=0}function et(){return X}function Mt(T){X=T}function Dt(){let T=X;return T>=s.maxTextures&&Rt("WebGLTextures: Trying to use "+(T+1)+" texture units while this GPU supports only "+s.maxTextures),X+=1,T}function J(T){let y=[];return y.push(T.wrapS),y.push(T.wrapT),y.push(T.wrapR||0),y.push(T.magFilter),y.push(T.minFilter),y.push(T.anisotropy),y.push(T.internalFormat),y.push(T.format),y.push(T.type),y.push(T.generateMipmaps),y.push(T.mipmapsAutoUpdate),y.push(T.premultiplyAlpha),y.push(T.flipY),y.push(T.unpackAlignment),y.push(T.colorSpace),y.join()}function mt(T,y){let k=i.get(T);if(T.isVideoTexture&&ye(T),T.isRenderTargetTexture===!1&&T.isExternalTexture!==!0&&T.version>0&&k.__version!==T.version){let nt=T.image;if(nt===null)Rt("WebGLRenderer: Texture marked for update but no image data found.");else if(nt.complete===!1)Rt("WebGLRenderer: Texture marked for update but image is incomplete");else{_e(k,T,y);return}}else T.isExternalTexture&&(k.__webglTexture=T.sourceTexture?T.sourceTexture:null);e.bindTexture(n.TEXTURE_2D,k.__webglTexture,n.TEXTURE0+y)}function yt(T,y){let k=i.get(T);if(T.isRenderTargetTexture===!1&&T.version>0&&k.__version!==T.version){_e(k,T,y);return}else T.isExternalTexture&&(k.__webglTexture=T.sourceTexture?T.sourceTexture:null);e.bindTexture(n.TEXTURE_2D_ARRAY,k.__webglTexture,n.TEXTURE0+y)}function Et(T,y){let k=i.get(T);if(T.isRenderTargetTexture===!1&&T.version>0&&k.__version!==T.version){_e(k,T,y);return}e.bindTexture(n.TEXTURE_3D,k.__webglTexture,n.TEXTURE0+y)}function gt(T,y){let k=i.get(T);if(T.version>0&&k.__version!==T.version){Je(k,T,y);return}e.bindTexture(n.TEXTURE_CUBE_MAP,k.__webglTexture,n.TEXTURE0+y)}let Ft={[To]:n.REPEAT,[kn]:n.CLAMP_TO_EDGE,[Eo]:n.MIRRORED_REPEAT},me={[ue]:n.NEAREST,[om]:n.NEAREST_MIPMAP_NEAREST,[Hr]:n.NEAREST_MIPMAP_LINEAR,[fe]:n.LINEAR,[jo]:n.LINEAR_MIPMAP_NEAREST,[si]:n.LINEAR_MIPMAP_LINEAR},It={[um]:n.NEVER,[Xh]:n.ALWAYS,[fm]:n.LESS,[Jr]:n.LEQUAL,[dm]:n.EQUAL,[Wh]:n.GEQUAL,[pm]:n.GREATER,[mm]:n.NOTEQUAL};function Qt(T,y){if(y.type===Rn&&t.has("OES_texture_float_linear")===!1&&(y.magFilter===fe||y.magFilter===jo||y.magFilter===Hr||y.magFilter===si||y.minFilter===fe||y.minFilter===jo||y.minFilter===Hr||y.minFilter===si)&&Rt("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(T,n.TEXTURE_WRAP_S,Ft[y.wrapS]),n.texParameteri(T,n.TEXTURE_WRAP_T,Ft[y.wrapT]),(T===n.TEXTURE_3D||T===n.TEXTURE_2D_ARRAY)&&n.texParameteri(T,n.TEXTURE_WRAP_R,Ft[y.wrapR]),n.texParameteri(T,n.TEXTURE_MAG_FILTER,me[y.magFilter]),n.texParameteri(T,n.TEXTURE_MIN_FILTER,me[y.minFilter]),y.compareFunction&&(n.texParameteri(T,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(T,n.TEXTURE_COMPARE_FUNC,It[y.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(y.magFilter===ue||y.minFilter!==Hr&&y.minFilter!==si||y.type===Rn&&t.has("OES_texture_float_linear")===!1)return;if(y.anisotropy>1||i.get(y).__currentAnisotropy){let k=t.get("EXT_texture_filter_anisotropic");n.texParameterf(T,k.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(y.anisotropy,s.getMaxAnisotropy())),i.get(y).__currentAnisotropy=y.anisotropy}}}function ee(T,y){let k=!1;T.__webglInit===void 0&&(T.__webglInit=!0,y.addEventListener("dispose",D),O(y));let nt=y.source,Q=d.get(nt);Q===void 0&&(Q={},d.set(nt,Q));let rt=J(y);if(rt!==T.__cacheKey){Q[rt]===void 0&&(Q[rt]={texture:n.createTexture(),usedTimes:0},a.memory.textures++,k=!0),Q[rt].usedTimes++;let ht=Q[T.__cacheKey];ht!==void 0&&(Q[T.__cacheKey].usedTimes--,ht.usedTimes===0&&G(y)),T.__cacheKey=rt,T.__webglTexture=Q[rt].texture}return k}function Gt(T,y,k){return Math.floor(Math.floor(T/k)/y)}function Ce(T,y,k,nt){let rt=T.updateRanges;if(rt.length===0)e.texSubImage2D(n.TEXTURE_2D,0,0,0,y.width,y.height,k,nt,y.data);else{rt.sort((R,K)=>R.start-K.start);let ht=0;for(let R=1;R<rt.length;R++){let K=rt[ht],q=rt[R],lt=K.start+K.count,st=Gt(q.start,y.width,4),at=Gt(K.start,y.width,4);q.start<=lt+1&&st===at&&Gt(q.start+q.count-1,y.width,4)===st?K.count=Math.max(K.count,q.start+q.count-K.start):(++ht,rt[ht]=q)}rt.length=ht+1;let $=e.getParameter(n.UNPACK_ROW_LENGTH),Z=e.getParameter(n.UNPACK_SKIP_PIXELS),ot=e.getParameter(n.UNPACK_SKIP_ROWS);e.pixelStorei(n.UNPACK_ROW_LENGTH,y.width);for(let R=0,K=rt.length;R<K;R++){let q=rt[R],lt=Math.floor(q.start/4),st=Math.ceil(q.count/4),at=lt%y.width,wt=Math.floor(lt/y.width),kt=st,it=1;e.pixelStorei(n.UNPACK_SKIP_PIXELS,at),e.pixelStorei(n.UNPACK_SKIP_ROWS,wt),e.texSubImage2D(n.TEXTURE_2D,0,at,wt,kt,it,k,nt,y.data)}T.clearUpdateRanges(),e.pixelStorei(n.UNPACK_ROW_LENGTH,$),e.pixelStorei(n.UNPACK_SKIP_PIXELS,Z),e.pixelStorei(n.UNPACK_SKIP_ROWS,ot)}}function _e(T,y,k){let nt=n.TEXTURE_2D;(y.isDataArrayTexture||y.isCompressedArrayTexture)&&(nt=n.TEXTURE_2D_ARRAY),y.isData3DTexture&&(nt=n.TEXTURE_3D);let Q=ee(T,y),rt=y.source;e.bindTexture(nt,T.__webglTexture,n.TEXTURE0+k);let ht=i.get(rt);if(rt.version!==ht.__version||Q===!0){if(e.activeTexture(n.TEXTURE0+k),(typeof ImageBitmap<"u"&&y.image instanceof ImageBitmap)===!1){let it=qt.getPrimaries(qt.workingColorSpace),At=y.colorSpace===ai?null:qt.getPrimaries(y.colorSpace),Bt=y.colorSpace===ai||it===At?n.NONE:n.BROWSER_DEFAULT_WEBGL;e.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,y.flipY),e.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,y.premultiplyAlpha),e.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,Bt)}e.pixelStorei(n.UNPACK_ALIGNMENT,y.unpackAlignment);let Z=M(y.image,!1,s.maxTextureSize);Z=Ct(y,Z);let ot=r.convert(y.format,y.colorSpace),R=r.convert(y.type),K=S(y.internalFormat,ot,R,y.normalized,y.colorSpace,y.isVideoTexture);Qt(nt,y);let q,lt=y.mipmaps,st=y.isVideoTexture!==!0,at=ht.__version===void 0||Q===!0,wt=rt.dataReady,kt=w(y,Z);if(y.isDepthTexture)K=x(y.format===ri,y.type),at&&(st?e.texStorage2D(n.TEXTURE_2D,1,K,Z.width,Z.height):e.texImage2D(n.TEXTURE_2D,0,K,Z.width,Z.height,0,ot,R,null));else if(y.isDataTexture)if(lt.length>0){st&&at&&e.texStorage2D(n.TEXTURE_2D,kt,K,lt[0].width,lt[0].height);for(let it=0,At=lt.length;it<At;it++)q=lt[it],st?wt&&e.texSubImage2D(n.TEXTURE_2D,it,0,0,q.width,q.height,ot,R,q.data):e.texImage2D(n.TEXTURE_2D,it,K,q.width,q.height,0,ot,R,q.data);y.generateMipmaps=!1}else st?(at&&e.texStorage2D(n.TEXTURE_2D,kt,K,Z.width,Z.height),wt&&Ce(y,Z,ot,R)):e.texImage2D(n.TEXTURE_2D,0,K,Z.width,Z.height,0,ot,R,Z.data);else if(y.isCompressedTexture)if(y.isCompressedArrayTexture){st&&at&&e.texStorage3D(n.TEXTURE_2D_ARRAY,kt,K,lt[0].width,lt[0].height,Z.depth);for(let it=0,At=lt.length;it<At;it++)if(q=lt[it],y.format!==cn)if(ot!==null)if(st){if(wt)if(y.layerUpdates.size>0){let Bt=eu(q.width,q.height,y.format,y.type);for(let pt of y.layerUpdates){let te=q.data.subarray(pt*Bt/q.data.BYTES_PER_ELEMENT,(pt+1)*Bt/q.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,it,0,0,pt,q.width,q.height,1,ot,te)}}else e.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,it,0,0,0,q.width,q.height,Z.depth,ot,q.data)}else e.compressedTexImage3D(n.TEXTURE_2D_ARRAY,it,K,q.width,q.height,Z.depth,0,q.data,0,0);else Rt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else st?wt&&e.texSubImage3D(n.TEXTURE_2D_ARRAY,it,0,0,0,q.width,q.height,Z.depth,ot,R,q.data):e.texImage3D(n.TEXTURE_2D_ARRAY,it,K,q.width,q.height,Z.depth,0,ot,R,q.data);y.layerUpdates.size>0&&y.clearLayerUpdates()}else{st&&at&&e.texStorage2D(n.TEXTURE_2D,kt,K,lt[0].width,lt[0].height);for(let it=0,At=lt.length;it<At;it++)q=lt[it],y.format!==cn?ot!==null?st?wt&&e.compressedTexSubImage2D(n.TEXTURE_2D,it,0,0,q.width,q.height,ot,q.data):e.compressedTexImage2D(n.TEXTURE_2D,it,K,q.width,q.height,0,q.data):Rt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):st?wt&&e.texSubImage2D(n.TEXTURE_2D,it,0,0,q.width,q.height,ot,R,q.data):e.texImage2D(n.TEXTURE_2D,it,K,q.width,q.height,0,ot,R,q.data)}else if(y.isDataArrayTexture)if(st){if(at&&e.texStorage3D(n.TEXTURE_2D_ARRAY,kt,K,Z.width,Z.height,Z.depth),wt)if(y.layerUpdates.size>0){let it=eu(Z.width,Z.height,y.format,y.type);for(let At of y.layerUpdates){let Bt=Z.data.subarray(At*it/Z.data.BYTES_PER_ELEMENT,(At+1)*it/Z.data.BYTES_PER_ELEMENT);e.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,At,Z.width,Z.height,1,ot,R,Bt)}y.clearLayerUpdates()}else e.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,Z.width,Z.height,Z.depth,ot,R,Z.data)}else e.texImage3D(n.TEXTURE_2D_ARRAY,0,K,Z.width,Z.height,Z.depth,0,ot,R,Z.data);else if(y.isData3DTexture)st?(at&&e.texStorage3D(n.TEXTURE_3D,kt,K,Z.width,Z.height,Z.depth),wt&&e.texSubImage3D(n.TEXTURE_3D,0,0,0,0,Z.width,Z.height,Z.depth,ot,R,Z.data)):e.texImage3D(n.TEXTURE_3D,0,K,Z.width,Z.height,Z.depth,0,ot,R,Z.data);else if(y.isFramebufferTexture){if(at)if(st)e.texStorage2D(n.TEXTURE_2D,kt,K,Z.width,Z.height);else{let it=Z.width,At=Z.height;for(let Bt=0;Bt<kt;Bt++)e.texImage2D(n.TEXTURE_2D,Bt,K,it,At,0,ot,R,null),it>>=1,At>>=1}}else if(y.isHTMLTexture){if("texElementImage2D"in n){let it=n.canvas;if(it.hasAttribute("layoutsubtree")||it.setAttribute("layoutsubtree","true"),Z.parentNode!==it){it.appendChild(Z),f.add(y),it.onpaint=At=>{let Bt=At.changedElements;for(let pt of f)Bt.includes(pt.image)&&(pt.needsUpdate=!0)},it.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,Z);else{let Bt=n.RGBA,pt=n.RGBA,te=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,Bt,pt,te,Z)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(lt.length>0){if(st&&at){let it=Nt(lt[0]);e.texStorage2D(n.TEXTURE_2D,kt,K,it.width,it.height)}for(let it=0,At=lt.length;it<At;it++)q=lt[it],st?wt&&e.texSubImage2D(n.TEXTURE_2D,it,0,0,ot,R,q):e.texImage2D(n.TEXTURE_2D,it,K,ot,R,q);y.generateMipmaps=!1}else if(st){if(at){let it=Nt(Z);e.texStorage2D(n.TEXTURE_2D,kt,K,it.width,it.height)}wt&&e.texSubImage2D(n.TEXTURE_2D,0,0,0,ot,R,Z)}else e.texImage2D(n.TEXTURE_2D,0,K,ot,R,Z);A(y)&&y.mipmapsAutoUpdate===!0&&b(nt),ht.__version=rt.version,y.onUpdate&&y.onUpdate(y)}T.__version=y.version}function Je(T,y,k){if(y.image.length!==6)return;let nt=ee(T,y),Q=y.source;e.bindTexture(n.TEXTURE_CUBE_MAP,T.__webglTexture,n.TEXTURE0+k);let rt=i.get(Q);if(Q.version!==rt.__version||nt===!0){e.activeTexture(n.TEXTURE0+k);let ht=qt.getPrimaries(qt.workingColorSpace),$=y.colorSpace===ai?null:qt.getPrimaries(y.colorSpace),Z=y.colorSpace===ai||ht===$?n.NONE:n.BROWSER_DEFAULT_WEBGL;e.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,y.flipY),e.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,y.premultiplyAlpha),e.pixelStorei(n.UNPACK_ALIGNMENT,y.unpackAlignment),e.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,Z);let ot=y.isCompressedTexture||y.image[0].isCompressedTexture,R=y.image[0]&&y.image[0].isDataTexture,K=[];for(let pt=0;pt<6;pt++)!ot&&!R?K[pt]=M(y.image[pt],!0,s.maxCubemapSize):K[pt]=R?y.image[pt].image:y.image[pt],K[pt]=Ct(y,K[pt]);let q=K[0],lt=r.convert(y.format,y.colorSpace),st=r.convert(y.type),at=S(y.internalFormat,lt,st,y.normalized,y.colorSpace),wt=y.isVideoTexture!==!0,kt=rt.__version===void 0||nt===!0,it=Q.dataReady,At=w(y,q);Qt(n.TEXTURE_CUBE_MAP,y);let Bt;if(y.isDepthTexture){if(at=x(y.format===ri,y.type),kt)if(wt)e.texStorage2D(n.TEXTURE_CUBE_MAP,1,at,q.width,q.height);else for(let pt=0;pt<6;pt++)e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,0,at,q.width,q.height,0,lt,st,null)}else if(ot){wt&&kt&&e.texStorage2D(n.TEXTURE_CUBE_MAP,At,at,q.width,q.height);for(let pt=0;pt<6;pt++){Bt=K[pt].mipmaps;for(let te=0;te<Bt.length;te++){let we=Bt[te];y.format!==cn?lt!==null?wt?it&&e.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,te,0,0,we.width,we.height,lt,we.data):e.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,te,at,we.width,we.height,0,we.data):Rt("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):wt?it&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,te,0,0,we.width,we.height,lt,st,we.data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,te,at,we.width,we.height,0,lt,st,we.data)}}}else{if(Bt=y.mipmaps,wt&&kt){Bt.length>0&&At++;let pt=Nt(K[0]);e.texStorage2D(n.TEXTURE_CUBE_MAP,At,at,pt.width,pt.height)}for(let pt=0;pt<6;pt++)if(R){wt?it&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,0,0,0,K[pt].width,K[pt].height,lt,st,K[pt].data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,0,at,K[pt].width,K[pt].height,0,lt,st,K[pt].data);for(let te=0;te<Bt.length;te++){let oi=Bt[te].image[pt].image;wt?it&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,te+1,0,0,oi.width,oi.height,lt,st,oi.data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,te+1,at,oi.width,oi.height,0,lt,st,oi.data)}}else{wt?it&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,0,0,0,lt,st,K[pt]):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,0,at,lt,st,K[pt]);for(let te=0;te<Bt.length;te++){let we=Bt[te];wt?it&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,te+1,0,0,lt,st,we.image[pt]):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+pt,te+1,at,lt,st,we.image[pt])}}}A(y)&&y.mipmapsAutoUpdate===!0&&b(n.TEXTURE_CUBE_MAP),rt.__version=Q.version,y.onUpdate&&y.onUpdate(y)}T.__version=y.version}function ce(T,y,k,nt,Q,rt){let ht=r.convert(k.format,k.colorSpace),$=r.convert(k.type),Z=S(k.internalFormat,ht,$,k.normalized,k.colorSpace),ot=i.get(y),R=i.get(k);if(R.__renderTarget=y,!ot.__hasExternalTextures){let K=Math.max(1,y.width>>rt),q=Math.max(1,y.height>>rt);Q===n.TEXTURE_3D||Q===n.TEXTURE_2D_ARRAY?e.texImage3D(Q,rt,Z,K,q,y.depth,0,ht,$,null):e.texImage2D(Q,rt,Z,K,q,0,ht,$,null)}e.bindFramebuffer(n.FRAMEBUFFER,T),dt(y)?o.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,nt,Q,R.__webglTexture,0,le(y)):(Q===n.TEXTURE_2D||Q>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&Q<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,nt,Q,R.__webglTexture,rt),e.bindFramebuffer(n.FRAMEBUFFER,null)}function Pn(T,y,k){if(n.bindRenderbuffer(n.RENDERBUFFER,T),y.depthBuffer){let nt=y.depthTexture,Q=nt&&nt.isDepthTexture?nt.type:null,rt=x(y.stencilBuffer,Q),ht=y.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;dt(y)?o.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,le(y),rt,y.width,y.height):k?n.renderbufferStorageMultisample(n.RENDERBUFFER,le(y),rt,y.width,y.height):n.renderbufferStorage(n.RENDERBUFFER,rt,y.width,y.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,ht,n.RENDERBUFFER,T)}else{let nt=y.textures;for(let Q=0;Q<nt.length;Q++){let rt=nt[Q],ht=r.convert(rt.format,rt.colorSpace),$=r.convert(rt.type),Z=S(rt.internalFormat,ht,$,rt.normalized,rt.colorSpace);dt(y)?o.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,le(y),Z,y.width,y.height):k?n.renderbufferStorageMultisample(n.RENDERBUFFER,le(y),Z,y.width,y.height):n.renderbufferStorage(n.RENDERBUFFER,Z,y.width,y.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function Se(T,y,k){let nt=y.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(n.FRAMEBUFFER,T),!(y.depthTexture&&y.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let Q=i.get(y.depthTexture);Q.__renderTarget=y;let rt=nt?y.depthTexture.image[0]:y.depthTexture.image;(!Q.__webglTexture||rt.width!==y.width||rt.height!==y.height)&&(rt.width=y.width,rt.height=y.height,y.depthTexture.needsUpdate=!0),nt?gt(y.depthTexture,0):mt(y.depthTexture,0);let ht=Q.__webglTexture,$=le(y),Z=nt?n.TEXTURE_CUBE_MAP_POSITIVE_X+k:n.TEXTURE_2D,ot=y.depthTexture.format===ri?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(y.depthTexture.format===ii)dt(y)?o.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ot,Z,ht,0,$):n.framebufferTexture2D(n.FRAMEBUFFER,ot,Z,ht,0);else if(y.depthTexture.format===ri)dt(y)?o.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ot,Z,ht,0,$):n.framebufferTexture2D(n.FRAMEBUFFER,ot,Z,ht,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function hn(T){let y=i.get(T),k=T.isWebGLCubeRenderTarget===!0;if(y.__boundDepthTexture!==T.depthTexture){let nt=T.depthTexture;if(y.__depthDisposeCallback&&y.__depthDisposeCallback(),nt){let Q=()=>{delete y.__boundDepthTexture,delete y.__depthDisposeCallback,nt.removeEventListener("dispose",Q)};nt.addEventListener("dispose",Q),y.__depthDisposeCallback=Q}y.__boundDepthTexture=nt}if(T.depthTexture&&!y.__autoAllocateDepthBuffer)if(k)for(let nt=0;nt<6;nt++)Se(y.__webglFramebuffer[nt],T,nt);else T.texture.mipmaps.length>0?Se(y.__webglFramebuffer[0],T,0):Se(y.__webglFramebuffer,T,0);else if(k){y.__webglDepthbuffer=[];for(let nt=0;nt<6;nt++)if(e.bindFramebuffer(n.FRAMEBUFFER,y.__webglFramebuffer[nt]),y.__webglDepthbuffer[nt]===void 0)y.__webglDepthbuffer[nt]=n.createRenderbuffer(),Pn(y.__webglDepthbuffer[nt],T,!1);else{let Q=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,rt=y.__webglDepthbuffer[nt];n.bindRenderbuffer(n.RENDERBUFFER,rt),n.framebufferRenderbuffer(n.FRAMEBUFFER,Q,n.RENDERBUFFER,rt)}}else if(T.texture.mipmaps.length>0?e.bindFramebuffer(n.FRAMEBUFFER,y.__webglFramebuffer[0]):e.bindFramebuffer(n.FRAMEBUFFER,y.__webglFramebuffer),y.__webglDepthbuffer===void 0)y.__webglDepthbuffer=n.createRenderbuffer(),Pn(y.__webglDepthbuffer,T,!1);else{let Q=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,rt=y.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,rt),n.framebufferRenderbuffer(n.FRAMEBUFFER,Q,n.RENDERBUFFER,rt)}e.bindFramebuffer(n.FRAMEBUFFER,null)}function un(T,y,k){let nt=i.get(T);y!==void 0&&ce(nt.__webglFramebuffer,T,T.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),k!==void 0&&hn(T)}function fn(T){let y=T.texture,k=i.get(T),nt=i.get(y);T.addEventListener("dispose",N),O(T);let Q=T.textures,rt=T.isWebGLCubeRenderTarget===!0,ht=Q.length>1;if(ht||(nt.__webglTexture===void 0&&(nt.__webglTexture=n.createTexture()),nt.__version=y.version,a.memory.textures++),rt){k.__webglFramebuffer=[];for(let $=0;$<6;$++)if(y.mipmaps.length>0){k.__webglFramebuffer[$]=[];for(let Z=0;Z<y.mipmaps.length;Z++)k.__webglFramebuffer[$][Z]=n.createFramebuffer()}else k.__webglFramebuffer[$]=n.createFramebuffer()}else{if(y.mipmaps.length>0){k.__webglFramebuffer=[];for(let $=0;$<y.mipmaps.length;$++)k.__webglFramebuffer[$]=n.createFramebuffer()}else k.__webglFramebuffer=n.createFramebuffer();if(ht)for(let $=0,Z=Q.length;$<Z;$++){let ot=i.get(Q[$]);ot.__webglTexture===void 0&&(ot.__webglTexture=n.createTexture(),a.memory.textures++)}if(T.samples>0&&dt(T)===!1){k.__webglMultisampledFramebuffer=n.createFramebuffer(),k.__webglColorRenderbuffer=[],e.bindFramebuffer(n.FRAMEBUFFER,k.__webglMultisampledFramebuffer);for(let $=0;$<Q.length;$++){let Z=Q[$];k.__webglColorRenderbuffer[$]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,k.__webglColorRenderbuffer[$]);let ot=r.convert(Z.format,Z.colorSpace),R=r.convert(Z.type),K=S(Z.internalFormat,ot,R,Z.normalized,Z.colorSpace,T.isXRRenderTarget===!0),q=le(T);n.renderbufferStorageMultisample(n.RENDERBUFFER,q,K,T.width,T.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+$,n.RENDERBUFFER,k.__webglColorRenderbuffer[$])}n.bindRenderbuffer(n.RENDERBUFFER,null),T.depthBuffer&&(k.__webglDepthRenderbuffer=n.createRenderbuffer(),Pn(k.__webglDepthRenderbuffer,T,!0)),e.bindFramebuffer(n.FRAMEBUFFER,null)}}if(rt){e.bindTexture(n.TEXTURE_CUBE_MAP,nt.__webglTexture),Qt(n.TEXTURE_CUBE_MAP,y);for(let $=0;$<6;$++)if(y.mipmaps.length>0)for(let Z=0;Z<y.mipmaps.length;Z++)ce(k.__webglFramebuffer[$][Z],T,y,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+$,Z);else ce(k.__webglFramebuffer[$],T,y,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+$,0);A(y)?b(n.TEXTURE_CUBE_MAP):y.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,y.mipmaps.length-1),e.unbindTexture()}else if(ht){for(let $=0,Z=Q.length;$<Z;$++){let ot=Q[$],R=i.get(ot),K=n.TEXTURE_2D;(T.isWebGL3DRenderTarget||T.isWebGLArrayRenderTarget)&&(K=T.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),e.bindTexture(K,R.__webglTexture),Qt(K,ot),ce(k.__webglFramebuffer,T,ot,n.COLOR_ATTACHMENT0+$,K,0),A(ot)&&b(K)}e.unbindTexture()}else{let $=n.TEXTURE_2D;if((T.isWebGL3DRenderTarget||T.isWebGLArrayRenderTarget)&&($=T.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),e.bindTexture($,nt.__webglTexture),Qt($,y),y.mipmaps.length>0)for(let Z=0;Z<y.mipmaps.length;Z++)ce(k.__webglFramebuffer[Z],T,y,n.COLOR_ATTACHMENT0,$,Z);else ce(k.__webglFramebuffer,T,y,n.COLOR_ATTACHMENT0,$,0);A(y)?b($):y.mipmaps.length>0&&n.texParameteri($,n.TEXTURE_MAX_LEVEL,y.mipmaps.length-1),e.unbindTexture()}T.depthBuffer&&hn(T)}function U(T){let y=T.textures;for(let k=0,nt=y.length;k<nt;k++){let Q=y[k];if(A(Q)&&Q.mipmapsAutoUpdate===!0){let rt=E(T),ht=i.get(Q).__webglTexture;e.bindTexture(rt,ht),b(rt),e.unbindTexture()}}}let dn=[];function oe(T){if(T.samples>0){if(dt(T)===!1){let y=T.textures,k=T.width,nt=T.height,Q=n.COLOR_BUFFER_BIT,rt=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ht=i.get(T),$=y.length>1;if($)for(let ot=0;ot<y.length;ot++)e.bindFramebuffer(n.FRAMEBUFFER,ht.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ot,n.RENDERBUFFER,null),e.bindFramebuffer(n.FRAMEBUFFER,ht.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+ot,n.TEXTURE_2D,null,0);e.bindFramebuffer(n.READ_FRAMEBUFFER,ht.__webglMultisampledFramebuffer),T.texture.mipmaps.length>0?e.bindFramebuffer(n.DRAW_FRAMEBUFFER,ht.__webglFramebuffer[0]):e.bindFramebuffer(n.DRAW_FRAMEBUFFER,ht.__webglFramebuffer);for(let ot=0;ot<y.length;ot++){if(T.resolveDepthBuffer&&(T.depthBuffer&&(Q|=n.DEPTH_BUFFER_BIT),T.stencilBuffer&&T.resolveStencilBuffer&&(Q|=n.STENCIL_BUFFER_BIT)),$){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,ht.__webglColorRenderbuffer[ot]);let R=i.get(y[ot]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,R,0)}n.blitFramebuffer(0,0,k,nt,0,0,k,nt,Q,n.NEAREST),l===!0&&(dn.length=0,dn.push(n.COLOR_ATTACHMENT0+ot),T.depthBuffer&&T.storeMultisampledDepthBuffer===!1&&dn.push(rt),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,dn))}if(e.bindFramebuffer(n.READ_FRAMEBUFFER,null),e.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),$)for(let ot=0;ot<y.length;ot++){e.bindFramebuffer(n.FRAMEBUFFER,ht.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ot,n.RENDERBUFFER,ht.__webglColorRenderbuffer[ot]);let R=i.get(y[ot]).__webglTexture;e.bindFramebuffer(n.FRAMEBUFFER,ht.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+ot,n.TEXTURE_2D,R,0)}e.bindFramebuffer(n.DRAW_FRAMEBUFFER,ht.__webglMultisampledFramebuffer)}else if(T.depthBuffer&&T.storeMultisampledDepthBuffer===!1&&l){let y=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[y])}}}function le(T){return Math.min(s.maxSamples,T.samples)}function dt(T){let y=i.get(T);return T.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&y.__useRenderToTexture!==!1}function ye(T){let y=a.render.frame;h.get(T)!==y&&(h.set(T,y),T.update())}function Ct(T,y){let k=T.colorSpace,nt=T.format,Q=T.type;return T.isCompressedTexture===!0||T.isVideoTexture===!0||k!==Zi&&k!==ai&&(qt.getTransfer(k)===jt?(nt!==cn||Q!==$e)&&Rt("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Pt("WebGLTextures: Unsupported texture color space:",k)),y}function Nt(T){return typeof HTMLImageElement<"u"&&T instanceof HTMLImageElement?(c.width=T.naturalWidth||T.width,c.height=T.naturalHeight||T.height):typeof VideoFrame<"u"&&T instanceof VideoFrame?(c.width=T.displayWidth,c.height=T.displayHeight):(c.width=T.width,c.height=T.height),c}this.allocateTextureUnit=Dt,this.resetTextureUnits=j,this.getTextureUnits=et,this.setTextureUnits=Mt,this.setTexture2D=mt,this.setTexture2DArray=yt,this.setTexture3D=Et,this.setTextureCube=gt,this.rebindTextures=un,this.setupRenderTarget=fn,this.updateRenderTargetMipmap=U,this.updateMultisampleRenderTarget=oe,this.setupDepthRenderbuffer=hn,this.setupFrameBufferTexture=ce,this.useMultisampledRTT=dt,this.dispose=W}function a1(n,t){function e(i,s=ai){let r,a=qt.getTransfer(s);if(i===$e)return n.UNSIGNED_BYTE;if(i===tl)return n.UNSIGNED_SHORT_4_4_4_4;if(i===el)return n.UNSIGNED_SHORT_5_5_5_1;if(i===Bh)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===kh)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===Fh)return n.BYTE;if(i===Oh)return n.SHORT;if(i===Js)return n.UNSIGNED_SHORT;if(i===Qo)return n.INT;if(i===Ye)return n.UNSIGNED_INT;if(i===Rn)return n.FLOAT;if(i===In)return n.HALF_FLOAT;if(i===zh)return n.ALPHA;if(i===Vh)return n.RGB;if(i===cn)return n.RGBA;if(i===ii)return n.DEPTH_COMPONENT;if(i===ri)return n.DEPTH_STENCIL;if(i===Gh)return n.RED;if(i===nl)return n.RED_INTEGER;if(i===Ii)return n.RG;if(i===il)return n.RG_INTEGER;if(i===sl)return n.RGBA_INTEGER;if(i===Wr||i===Xr||i===qr||i===$r)if(a===jt)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===Wr)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===Xr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===qr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===$r)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===Wr)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===Xr)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===qr)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===$r)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===rl||i===al||i===ol||i===ll)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===rl)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===al)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===ol)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===ll)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===cl||i===hl||i===ul||i===fl||i===dl||i===Yr||i===pl)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(i===cl||i===hl)return a===jt?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===ul)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===fl)return r.COMPRESSED_R11_EAC;if(i===dl)return r.COMPRESSED_SIGNED_R11_EAC;if(i===Yr)return r.COMPRESSED_RG11_EAC;if(i===pl)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===ml||i===gl||i===xl||i===_l||i===yl||i===vl||i===bl||i===Ml||i===Sl||i===wl||i===Al||i===Tl||i===El||i===Cl)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(i===ml)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===gl)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===xl)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===_l)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===yl)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===vl)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===bl)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===Ml)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Sl)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===wl)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===Al)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===Tl)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===El)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Cl)return a===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===Rl||i===Il||i===Pl)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(i===Rl)return a===jt?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===Il)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===Pl)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===Ll||i===Nl||i===Zr||i===Dl)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(i===Ll)return r.COMPRESSED_RED_RGTC1_EXT;if(i===Nl)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===Zr)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===Dl)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===es?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:e}}var o1=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,l1=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,hu=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let i=new Fr(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=i}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,i=new pe({vertexShader:o1,fragmentShader:l1,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new de(new Gn(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},uu=class extends zn{constructor(t,e){super();let i=this,s=null,r=1,a=null,o="local-floor",l=1,c=null,h=null,f=null,u=null,d=null,m=null,_=typeof XRWebGLBinding<"u",p=new hu,g={},M=e.getContextAttributes(),A=null,b=null,E=[],S=[],x=new $t,w=null,O=null,P=new Xe;P.viewport=new Kt;let D=new Xe;D.viewport=new Kt;let N=[P,D],V=new Zo,I=null,W=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(J){let mt=E[J];return mt===void 0&&(mt=new Hs,E[J]=mt),mt.getTargetRaySpace()},this.getControllerGrip=function(J){let mt=E[J];return mt===void 0&&(mt=new Hs,E[J]=mt),mt.getGripSpace()},this.getHand=function(J){let mt=E[J];return mt===void 0&&(mt=new Hs,E[J]=mt),mt.getHandSpace()};function Y(J){let mt=S.indexOf(J.inputSource);if(mt===-1)return;let yt=E[mt];yt!==void 0&&(yt.update(J.inputSource,J.frame,c||a),yt.dispatchEvent({type:J.type,data:J.inputSource}))}function G(){s.removeEventListener("select",Y),s.removeEventListener("selectstart",Y),s.removeEventListener("selectend",Y),s.removeEventListener("squeeze",Y),s.removeEventListener("squeezestart",Y),s.removeEventListener("squeezeend",Y),s.removeEventListener("end",G),s.removeEventListener("inputsourceschange",tt);for(let J=0;J<E.length;J++){let mt=S[J];mt!==null&&(S[J]=null,E[J].disconnect(mt))}I=null,W=null,p.reset();for(let J in g)delete g[J];if(t.setRenderTarget(A),d=null,u=null,f=null,s=null,b=null,Dt.stop(),i.isPresenting=!1,t.setPixelRatio(w),t.setSize(x.width,x.height,!1),O!==null){let J=O.camera;J.fov=O.fov,J.zoom=O.zoom,J.updateProjectionMatrix(),O=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(J){r=J,i.isPresenting===!0&&Rt("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(J){o=J,i.isPresenting===!0&&Rt("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||a},this.setReferenceSpace=function(J){c=J},this.getBaseLayer=function(){return u!==null?u:d},this.getBinding=function(){return f===null&&_&&(f=new XRWebGLBinding(s,e)),f},this.getFrame=function(){return m},this.getSession=function(){return s},this.setSession=async function(J){if(s=J,s!==null){if(A=t.getRenderTarget(),s.addEventListener("select",Y),s.addEventListener("selectstart",Y),s.addEventListener("selectend",Y),s.addEventListener("squeeze",Y),s.addEventListener("squeezestart",Y),s.addEventListener("squeezeend",Y),s.addEventListener("end",G),s.addEventListener("inputsourceschange",tt),M.xrCompatible!==!0&&await e.makeXRCompatible(),w=t.getPixelRatio(),t.getSize(x),_&&"createProjectionLayer"in XRWebGLBinding.prototype){let yt=null,Et=null,gt=null;M.depth&&(gt=M.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,yt=M.stencil?ri:ii,Et=M.stencil?es:Ye);let Ft={colorFormat:e.RGBA8,depthFormat:gt,scaleFactor:r};f=this.getBinding(),u=f.createProjectionLayer(Ft),s.updateRenderState({layers:[u]}),t.setPixelRatio(1),t.setSize(u.textureWidth,u.textureHeight,!1),b=new Ie(u.textureWidth,u.textureHeight,{format:cn,type:$e,depthTexture:new on(u.textureWidth,u.textureHeight,Et,void 0,void 0,void 0,void 0,void 0,void 0,yt),stencilBuffer:M.stencil,colorSpace:t.outputColorSpace,samples:M.antialias?4:0,resolveDepthBuffer:u.ignoreDepthValues===!1,resolveStencilBuffer:u.ignoreDepthValues===!1,storeMultisampledDepthBuffer:u.ignoreDepthValues===!1,storeMultisampledStencilBuffer:u.ignoreDepthValues===!1})}else{let yt={antialias:M.antialias,alpha:!0,depth:M.depth,stencil:M.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(s,e,yt),s.updateRenderState({baseLayer:d}),t.setPixelRatio(1),t.setSize(d.framebufferWidth,d.framebufferHeight,!1),b=new Ie(d.framebufferWidth,d.framebufferHeight,{format:cn,type:$e,colorSpace:t.outputColorSpace,stencilBuffer:M.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}b.isXRRenderTarget=!0,this.setFoveation(l),c=null,a=await s.requestReferenceSpace(o),Dt.setContext(s),Dt.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return p.getDepthTexture()};function tt(J){for(let mt=0;mt<J.removed.length;mt++){let yt=J.removed[mt],Et=S.indexOf(yt);Et>=0&&(S[Et]=null,E[Et].disconnect(yt))}for(let mt=0;mt<J.added.length;mt++){let yt=J.added[mt],Et=S.indexOf(yt);if(Et===-1){for(let Ft=0;Ft<E.length;Ft++)if(Ft>=S.length){S.push(yt),Et=Ft;break}else if(S[Ft]===null){S[Ft]=yt,Et=Ft;break}if(Et===-1)break}let gt=E[Et];gt&&gt.connect(yt)}}function X(J,mt){mt===null?J.matrixWorld.copy(J.matrix):J.matrixWorld.multiplyMatrices(mt.matrixWorld,J.matrix),J.matrixWorldInverse.copy(J.matrixWorld).invert()}this.updateCamera=function(J){if(s===null)return;let mt=J.near,yt=J.far;p.texture!==null&&(p.depthNear>0&&(mt=p.depthNear),p.depthFar>0&&(yt=p.depthFar)),V.near=D.near=P.near=mt,V.far=D.far=P.far=yt,(I!==V.near||W!==V.far)&&(s.updateRenderState({depthNear:V.near,depthFar:V.far}),I=V.near,W=V.far),V.layers.mask=J.layers.mask|6,P.layers.mask=V.layers.mask&-5,D.layers.mask=V.layers.mask&-3;let Et=J.parent,gt=V.cameras;X(V,Et);for(let Ft=0;Ft<gt.length;Ft++)X(gt[Ft],Et);V.projectionMatrix.copy(P.projectionMatrix),V.projectionMatrixInverse.copy(P.projectionMatrixInverse),O===null&&J.isPerspectiveCamera&&(O={camera:J,fov:J.fov,zoom:J.zoom}),j(J,V,Et)};function j(J,mt,yt){yt===null?J.matrix.copy(mt.matrixWorld):(J.matrix.copy(yt.matrixWorld),J.matrix.invert(),J.matrix.multiply(mt.matrixWorld)),J.matrix.decompose(J.position,J.quaternion,J.scale),J.updateMatrixWorld(!0),J.projectionMatrix.copy(mt.projectionMatrix),J.projectionMatrixInverse.copy(mt.projectionMatrixInverse),J.isPerspectiveCamera&&(J.fov=Vs*2*Math.atan(1/J.projectionMatrix.elements[5]),J.zoom=1)}this.getCamera=function(){return V},this.getFoveation=function(){if(!(u===null&&d===null))return l},this.setFoveation=function(J){l=J,u!==null&&(u.fixedFoveation=J),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=J)},this.hasDepthSensing=function(){return p.texture!==null},this.getDepthSensingMesh=function(){return p.getMesh(V)},this.getCameraTexture=function(J){return g[J]};let et=null;function Mt(J,mt){if(h=mt.getViewerPose(c||a),m=mt,h!==null){let yt=h.views;d!==null&&(t.setRenderTargetFramebuffer(b,d.framebuffer),t.setRenderTarget(b));let Et=!1;yt.length!==V.cameras.length&&(V.cameras.length=0,Et=!0);for(let It=0;It<yt.length;It++){let Qt=yt[It],ee=null;if(d!==null)ee=d.getViewport(Qt);else{let Ce=f.getViewSubImage(u,Qt);ee=Ce.viewport,It===0&&(t.setRenderTargetTextures(b,Ce.colorTexture,Ce.depthStencilTexture),t.setRenderTarget(b))}let Gt=N[It];Gt===void 0&&(Gt=new Xe,Gt.layers.enable(It),Gt.viewport=new Kt,N[It]=Gt),Gt.matrix.fromArray(Qt.transform.matrix),Gt.matrix.decompose(Gt.position,Gt.quaternion,Gt.scale),Gt.projectionMatrix.fromArray(Qt.projectionMatrix),Gt.projectionMatrixInverse.copy(Gt.projectionMatrix).invert(),Gt.viewport.set(ee.x,ee.y,ee.width,ee.height),It===0&&(V.matrix.copy(Gt.matrix),V.matrix.decompose(V.position,V.quaternion,V.scale)),Et===!0&&V.cameras.push(Gt)}let gt=s.enabledFeatures;if(gt&&gt.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&_){f=i.getBinding();let It=f.getDepthInformation(yt[0]);It&&It.isValid&&It.texture&&p.init(It,s.renderState)}if(gt&&gt.includes("camera-access")&&_){t.state.unbindTexture(),f=i.getBinding();for(let It=0;It<yt.length;It++){let Qt=yt[It].camera;if(Qt){let ee=g[Qt];ee||(ee=new Fr,g[Qt]=ee);let Gt=f.getCameraImage(Qt);ee.sourceTexture=Gt}}}}for(let yt=0;yt<E.length;yt++){let Et=S[yt],gt=E[yt];Et!==null&&gt!==void 0&&gt.update(Et,mt,c||a)}et&&et(J,mt),mt.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:mt}),m=null}let Dt=new Wm;Dt.setAnimationLoop(Mt),this.setAnimationLoop=function(J){et=J},this.dispose=function(){}}},c1=new ie,tg=new Lt;tg.set(-1,0,0,0,1,0,0,0,1);function h1(n,t){function e(p,g){p.matrixAutoUpdate===!0&&p.updateMatrix(),g.value.copy(p.matrix)}function i(p,g){g.color.getRGB(p.fogColor.value,jh(n)),g.isFog?(p.fogNear.value=g.near,p.fogFar.value=g.far):g.isFogExp2&&(p.fogDensity.value=g.density)}function s(p,g,M,A,b){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(p,g):g.isMeshLambertMaterial?(r(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(p,g),f(p,g)):g.isMeshPhongMaterial?(r(p,g),h(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(p,g),u(p,g),g.isMeshPhysicalMaterial&&d(p,g,b)):g.isMeshMatcapMaterial?(r(p,g),m(p,g)):g.isMeshDepthMaterial?r(p,g):g.isMeshDistanceMaterial?(r(p,g),_(p,g)):g.isMeshNormalMaterial?r(p,g):g.isLineBasicMaterial?(a(p,g),g.isLineDashedMaterial&&o(p,g)):g.isPointsMaterial?l(p,g,M,A):g.isSpriteMaterial?c(p,g):g.isShadowMaterial?(p.color.value.copy(g.color),p.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(p,g){p.opacity.value=g.opacity,g.color&&p.diffuse.value.copy(g.color),g.emissive&&p.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.bumpMap&&(p.bumpMap.value=g.bumpMap,e(g.bumpMap,p.bumpMapTransform),p.bumpScale.value=g.bumpScale,g.side===qe&&(p.bumpScale.value*=-1)),g.normalMap&&(p.normalMap.value=g.normalMap,e(g.normalMap,p.normalMapTransform),p.normalScale.value.copy(g.normalScale),g.side===qe&&p.normalScale.value.negate()),g.displacementMap&&(p.displacementMap.value=g.displacementMap,e(g.displacementMap,p.displacementMapTransform),p.displacementScale.value=g.displacementScale,p.displacementBias.value=g.displacementBias),g.emissiveMap&&(p.emissiveMap.value=g.emissiveMap,e(g.emissiveMap,p.emissiveMapTransform)),g.specularMap&&(p.specularMap.value=g.specularMap,e(g.specularMap,p.specularMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest);let M=t.get(g),A=M.envMap,b=M.envMapRotation;A&&(p.envMap.value=A,p.envMapRotation.value.setFromMatrix4(c1.makeRotationFromEuler(b)).transpose(),A.isCubeTexture&&A.isRenderTargetTexture===!1&&p.envMapRotation.value.premultiply(tg),p.reflectivity.value=g.reflectivity,p.ior.value=g.ior,p.refractionRatio.value=g.refractionRatio),g.lightMap&&(p.lightMap.value=g.lightMap,p.lightMapIntensity.value=g.lightMapIntensity,e(g.lightMap,p.lightMapTransform)),g.aoMap&&(p.aoMap.value=g.aoMap,p.aoMapIntensity.value=g.aoMapIntensity,e(g.aoMap,p.aoMapTransform))}function a(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform))}function o(p,g){p.dashSize.value=g.dashSize,p.totalSize.value=g.dashSize+g.gapSize,p.scale.value=g.scale}function l(p,g,M,A){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.size.value=g.size*M,p.scale.value=A*.5,g.map&&(p.map.value=g.map,e(g.map,p.uvTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function c(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.rotation.value=g.rotation,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function h(p,g){p.specular.value.copy(g.specular),p.shininess.value=Math.max(g.shininess,1e-4)}function f(p,g){g.gradientMap&&(p.gradientMap.value=g.gradientMap)}function u(p,g){p.metalness.value=g.metalness,g.metalnessMap&&(p.metalnessMap.value=g.metalnessMap,e(g.metalnessMap,p.metalnessMapTransform)),p.roughness.value=g.roughness,g.roughnessMap&&(p.roughnessMap.value=g.roughnessMap,e(g.roughnessMap,p.roughnessMapTransform)),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)}function d(p,g,M){p.ior.value=g.ior,g.diffuseRoughness>0&&(p.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(p.diffuseRoughnessMap.value=g.diffuseRoughnessMap,e(g.diffuseRoughnessMap,p.diffuseRoughnessMapTransform))),g.sheen>0&&(p.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),p.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(p.sheenColorMap.value=g.sheenColorMap,e(g.sheenColorMap,p.sheenColorMapTransform)),g.sheenRoughnessMap&&(p.sheenRoughnessMap.value=g.sheenRoughnessMap,e(g.sheenRoughnessMap,p.sheenRoughnessMapTransform))),g.clearcoat>0&&(p.clearcoat.value=g.clearcoat,p.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(p.clearcoatMap.value=g.clearcoatMap,e(g.clearcoatMap,p.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,e(g.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(p.clearcoatNormalMap.value=g.clearcoatNormalMap,e(g.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===qe&&p.clearcoatNormalScale.value.negate())),g.dispersion>0&&(p.dispersion.value=g.dispersion),g.retroreflectivity>0&&(p.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(p.iridescence.value=g.iridescence,p.iridescenceIOR.value=g.iridescenceIOR,p.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,p.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(p.iridescenceMap.value=g.iridescenceMap,e(g.iridescenceMap,p.iridescenceMapTransform)),g.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=g.iridescenceThicknessMap,e(g.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),g.transmission>0&&(p.transmission.value=g.transmission,p.transmissionSamplerMap.value=M.texture,p.transmissionSamplerSize.value.set(M.width,M.height),g.transmissionMap&&(p.transmissionMap.value=g.transmissionMap,e(g.transmissionMap,p.transmissionMapTransform)),p.thickness.value=g.thickness,g.thicknessMap&&(p.thicknessMap.value=g.thicknessMap,e(g.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=g.attenuationDistance,p.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(p.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(p.anisotropyMap.value=g.anisotropyMap,e(g.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=g.specularIntensity,p.specularColor.value.copy(g.specularColor),g.specularColorMap&&(p.specularColorMap.value=g.specularColorMap,e(g.specularColorMap,p.specularColorMapTransform)),g.specularIntensityMap&&(p.specularIntensityMap.value=g.specularIntensityMap,e(g.specularIntensityMap,p.specularIntensityMapTransform))}function m(p,g){g.matcap&&(p.matcap.value=g.matcap)}function _(p,g){let M=t.get(g).light;p.referencePosition.value.setFromMatrixPosition(M.matrixWorld),p.nearDistance.value=M.shadow.camera.near,p.farDistance.value=M.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function u1(n,t,e,i){let s={},r={};function a(M,A){let b=A.program;i.uniformBlockBinding(M,b,s[M.id])}function o(M,A){let b=s[M.id];b===void 0&&(m(M),b=l(M),s[M.id]=b,M.addEventListener("dispose",p));let E=A.program;i.updateUBOMapping(M,E);let S=t.render.frame;r[M.id]!==S&&(c(M),r[M.id]=S)}function l(M){let A=n.createBuffer(),b=M.__size,E=M.usage;return n.bindBuffer(n.UNIFORM_BUFFER,A),n.bufferData(n.UNIFORM_BUFFER,b,E),n.bindBuffer(n.UNIFORM_BUFFER,null),A}function c(M){let A=s[M.id],b=M.uniforms,E=M.__cache;n.bindBuffer(n.UNIFORM_BUFFER,A);for(let S=0,x=b.length;S<x;S++){let w=b[S];if(Array.isArray(w))for(let O=0,P=w.length;O<P;O++)h(w[O],S,O,E);else h(w,S,0,E)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function h(M,A,b,E){if(u(M,A,b,E)===!0){let S=M.__offset,x=M.value;if(Array.isArray(x)){let w=0;for(let O=0;O<x.length;O++){let P=x[O],D=_(P,!0);f(P,M.__data,w),w+=D.storage/Float32Array.BYTES_PER_ELEMENT}}else f(x,M.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,S,M.__data)}}function f(M,A,b){typeof M=="number"||typeof M=="boolean"?A[b]=M:M.isMatrix3?(A[b]=M.elements[0],A[b+1]=M.elements[1],A[b+2]=M.elements[2],A[b+3]=0,A[b+4]=M.elements[3],A[b+5]=M.elements[4],A[b+6]=M.elements[5],A[b+7]=0,A[b+8]=M.elements[6],A[b+9]=M.elements[7],A[b+10]=M.elements[8],A[b+11]=0):ArrayBuffer.isView(M)?A.set(M.subarray(0,A.length-b),b):M.toArray(A,b)}function u(M,A,b,E){let S=M.value,x=A+"_"+b;if(Array.isArray(S)){E[x]===void 0&&(E[x]=[]);let w=E[x],O=!1;for(let P=0;P<S.length;P++)d(S[P],w,P)===!0&&(O=!0);return O}return d(S,E,x)}function d(M,A,b){if(A[b]===void 0)return typeof M=="number"||typeof M=="boolean"?A[b]=M:ArrayBuffer.isView(M)?A[b]=M.slice():A[b]=M.clone(),!0;{let E=A[b];if(typeof M=="number"||typeof M=="boolean"){if(E!==M)return A[b]=M,!0}else{if(ArrayBuffer.isView(M))return!0;if(E.equals(M)===!1)return E.copy(M),!0}}return!1}function m(M){let A=M.uniforms,b=0,E=16;for(let x=0,w=A.length;x<w;x++){let O=Array.isArray(A[x])?A[x]:[A[x]];for(let P=0,D=O.length;P<D;P++){let N=O[P],V=Array.isArray(N.value)?N.value:[N.value],I=Array.isArray(A[x])||Array.isArray(N.value),W=b;for(let G=0,tt=V.length;G<tt;G++){let X=V[G],j=_(X,I),et=b%E,Mt=et%j.boundary,Dt=et+Mt;b+=Mt,Dt!==0&&E-Dt<j.storage&&(b+=E-Dt),G===0&&(W=b),b+=j.storage}let Y=N.type==="int"?Int32Array:N.type==="uint"?Uint32Array:Float32Array;N.__data=new Y((b-W)/Float32Array.BYTES_PER_ELEMENT),N.__offset=W}}let S=b%E;return S>0&&(b+=E-S),M.__size=b,M.__cache={},this}function _(M,A){let b={boundary:0,storage:0};return typeof M=="number"||typeof M=="boolean"?(b.boundary=4,b.storage=4):M.isVector2?(b.boundary=8,b.storage=8):M.isVector3||M.isColor?(b.boundary=16,b.storage=12):M.isVector4?(b.boundary=16,b.storage=16):M.isMatrix3?(b.boundary=16,b.storage=48):M.isMatrix4?(b.boundary=16,b.storage=64):M.isTexture?Rt("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(M)?(b.boundary=16,b.storage=M.byteLength):Rt("WebGLRenderer: Unsupported uniform value type.",M),A===!0&&(b.boundary=16,b.storage=Math.ceil(b.storage/16)*16),b}function p(M){let A=M.target;A.removeEventListener("dispose",p),n.deleteBuffer(s[A.id]),delete s[A.id],delete r[A.id]}function g(){for(let M in s)n.deleteBuffer(s[M]);s={},r={}}return{bind:a,update:o,dispose:g}}var f1=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Wn=null;function d1(){return Wn===null&&(Wn=new Ws(f1,16,16,Ii,In),Wn.name="DFG_LUT",Wn.minFilter=fe,Wn.magFilter=fe,Wn.wrapS=kn,Wn.wrapT=kn,Wn.generateMipmaps=!1,Wn.needsUpdate=!0),Wn}var kl=class{constructor(t={}){let{canvas:e=gm(),context:i=null,depth:s=!0,stencil:r=!1,alpha:a=!1,antialias:o=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:f=!1,reversedDepthBuffer:u=!1,outputBufferType:d=$e}=t;this.isWebGLRenderer=!0;let m;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");m=i.getContextAttributes().alpha}else m=a;let _=d,p=new Set([sl,il,nl]),g=new Set([$e,Ye,Js,es,tl,el]),M=new Uint32Array(4),A=new Int32Array(4),b={textures:[],min:[],max:[],resolution:[]},E=null,S=null,x=[],w=[],O=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Hn,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let P=this,D=!1,N=null,V=null,I=null,W=null;this._outputColorSpace=nn;let Y=0,G=0,tt=null,X=-1,j=null,et=new Kt,Mt=new Kt,Dt=null,J=new Yt(0),mt=0,yt=e.width,Et=e.height,gt=1,Ft=null,me=null,It=new Kt(0,0,yt,Et),Qt=new Kt(0,0,yt,Et),ee=!1,Gt=new Ji,Ce=new Do,_e=!1,Je=!1,ce=new ie,Pn=new F,Se=new Kt,hn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},un=!1;function fn(){return tt===null?gt:1}let U=i;function dn(v,L){return e.getContext(v,L)}let oe,le,dt,ye,Ct,Nt,T,y,k,nt,Q,rt,ht,$,Z,ot,R,K,q,lt,st,at,wt;try{let v={alpha:!0,depth:s,stencil:r,antialias:o,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:f};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",At,!1),e.addEventListener("webglcontextrestored",Bt,!1),e.addEventListener("webglcontextcreationerror",pt,!1),U===null){let L="webgl2";if(U=dn(L,v),U===null)throw dn(L)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}kt()}catch(v){throw e.removeEventListener("webglcontextlost",At,!1),e.removeEventListener("webglcontextrestored",Bt,!1),e.removeEventListener("webglcontextcreationerror",pt,!1),Pt("WebGLRenderer: "+v.message),v}function kt(){oe=new wM(U),oe.init(),st=new a1(U,oe),le=new dM(U,oe,t,st),dt=new s1(U,oe),le.reversedDepthBuffer&&u&&dt.buffers.depth.setReversed(!0),V=U.createFramebuffer(),I=U.createFramebuffer(),W=U.createFramebuffer(),ye=new EM(U),Ct=new WS,Nt=new r1(U,oe,dt,Ct,le,st,ye),T=new SM(P),y=new Ry(U),at=new uM(U,y),k=new AM(U,y,ye,at),nt=new RM(U,k,y,at,ye),K=new CM(U,le,Nt),Z=new pM(Ct),Q=new HS(P,T,oe,le,at,Z),rt=new h1(P,Ct),ht=new qS,$=new jS(oe),R=new hM(P,T,dt,nt,m,l),ot=new i1(P,nt,le),wt=new u1(U,ye,le,dt),q=new fM(U,oe,ye),lt=new TM(U,oe,ye),ye.programs=Q.programs,P.capabilities=le,P.extensions=oe,P.properties=Ct,P.renderLists=ht,P.shadowMap=ot,P.state=dt,P.info=ye}_!==$e&&(O=new PM(_,e.width,e.height,o,s,r));let it=new uu(P,U);this.xr=it,this.getContext=function(){return U},this.getContextAttributes=function(){return U.getContextAttributes()},this.forceContextLoss=function(){let v=oe.get("WEBGL_lose_context");v&&v.loseContext()},this.forceContextRestore=function(){let v=oe.get("WEBGL_lose_context");v&&v.restoreContext()},this.getPixelRatio=function(){return gt},this.setPixelRatio=function(v){v!==void 0&&(gt=v,this.setSize(yt,Et,!1))},this.getSize=function(v){return v.set(yt,Et)},this.setSize=function(v,L,H=!0){if(it.isPresenting){Rt("WebGLRenderer: Can't change size while VR device is presenting.");return}yt=v,Et=L,e.width=Math.floor(v*gt),e.height=Math.floor(L*gt),H===!0&&(e.style.width=v+"px",e.style.height=L+"px"),O!==null&&O.setSize(e.width,e.height),this.setViewport(0,0,v,L)},this.getDrawingBufferSize=function(v){return v.set(yt*gt,Et*gt).floor()},this.setDrawingBufferSize=function(v,L,H){yt=v,Et=L,gt=H,e.width=Math.floor(v*H),e.height=Math.floor(L*H),this.setViewport(0,0,v,L)},this.setEffects=function(v){if(_===$e){Pt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(v){for(let L=0;L<v.length;L++)if(v[L].isOutputPass===!0){Rt("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}O.setEffects(v||[])},this.getCurrentViewport=function(v){return v.copy(et)},this.getViewport=function(v){return v.copy(It)},this.setViewport=function(v,L,H,B){v.isVector4?It.set(v.x,v.y,v.z,v.w):It.set(v,L,H,B),dt.viewport(et.copy(It).multiplyScalar(fn()).round())},this.getScissor=function(v){return v.copy(Qt)},this.setScissor=function(v,L,H,B){v.isVector4?Qt.set(v.x,v.y,v.z,v.w):Qt.set(v,L,H,B),dt.scissor(Mt.copy(Qt).multiplyScalar(fn()).round())},this.getScissorTest=function(){return ee},this.setScissorTest=function(v){dt.setScissorTest(ee=v)},this.setOpaqueSort=function(v){Ft=v},this.setTransparentSort=function(v){me=v},this.getClearColor=function(v){return v.copy(R.getClearColor())},this.setClearColor=function(){R.setClearColor(...arguments)},this.getClearAlpha=function(){return R.getClearAlpha()},this.setClearAlpha=function(){R.setClearAlpha(...arguments)},this.clear=function(v=!0,L=!0,H=!0){let B=0;if(v){let z=!1;if(tt!==null){let ut=tt.texture.format;z=p.has(ut)}if(z){let ut=tt.texture.type,_t=g.has(ut),ct=R.getClearColor(),xt=R.getClearAlpha(),St=ct.r,Ut=ct.g,Ht=ct.b;_t?(M[0]=St,M[1]=Ut,M[2]=Ht,M[3]=xt,U.clearBufferuiv(U.COLOR,0,M)):(A[0]=St,A[1]=Ut,A[2]=Ht,A[3]=xt,U.clearBufferiv(U.COLOR,0,A))}else B|=U.COLOR_BUFFER_BIT}L&&(B|=U.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),H&&(B|=U.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),B!==0&&U.clear(B)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(v){v.setRenderer(this),N=v},this.dispose=function(){e.removeEventListener("webglcontextlost",At,!1),e.removeEventListener("webglcontextrestored",Bt,!1),e.removeEventListener("webglcontextcreationerror",pt,!1),R.dispose(),ht.dispose(),$.dispose(),Nt.dispose(),Ct.dispose(),T.dispose(),nt.dispose(),k.dispose(),at.dispose(),wt.dispose(),Q.dispose(),it.dispose(),it.removeEventListener("sessionstart",Eu),it.removeEventListener("sessionend",Cu),Li.stop()};function At(v){v.preventDefault(),Cr("WebGLRenderer: Context Lost."),D=!0}function Bt(){Cr("WebGLRenderer: Context Restored."),D=!1;let v=ye.autoReset,L=ot.enabled,H=ot.autoUpdate,B=ot.needsUpdate,z=ot.type;kt(),ye.autoReset=v,ot.enabled=L,ot.autoUpdate=H,ot.needsUpdate=B,ot.type=z}function pt(v){Pt("WebGLRenderer: A WebGL context could not be created. Reason: ",v.statusMessage)}function te(v){let L=v.target;L.removeEventListener("dispose",te),we(L)}function we(v){oi(v),Ct.remove(v)}function oi(v){let L=Ct.get(v).programs;L!==void 0&&(L.forEach(function(H){Q.releaseProgram(H)}),v.isShaderMaterial&&Q.releaseShaderCache(v))}this.renderBufferDirect=function(v,L,H,B,z,ut){L===null&&(L=hn);let _t=z.isMesh&&z.matrixWorld.determinantAffine()<0,ct=qg(v,L,H,B,z);dt.setMaterial(B,_t);let xt=H.index,St=1;if(B.wireframe===!0){if(xt=k.getWireframeAttribute(H),xt===void 0)return;St=2}let Ut=H.drawRange,Ht=H.attributes.position,vt=Ut.start*St,Wt=(Ut.start+Ut.count)*St;ut!==null&&(vt=Math.max(vt,ut.start*St),Wt=Math.min(Wt,(ut.start+ut.count)*St)),xt!==null?(vt=Math.max(vt,0),Wt=Math.min(Wt,xt.count)):Ht!=null&&(vt=Math.max(vt,0),Wt=Math.min(Wt,Ht.count));let ge=Wt-vt;if(ge<0||ge===1/0)return;at.setup(z,B,ct,H,xt);let se,ne=q;if(xt!==null&&(se=y.get(xt),ne=lt,ne.setIndex(se)),z.isMesh)B.wireframe===!0?(dt.setLineWidth(B.wireframeLinewidth*fn()),ne.setMode(U.LINES)):ne.setMode(U.TRIANGLES);else if(z.isLine){let Ue=B.linewidth;Ue===void 0&&(Ue=1),dt.setLineWidth(Ue*fn()),z.isLineSegments?ne.setMode(U.LINES):z.isLineLoop?ne.setMode(U.LINE_LOOP):ne.setMode(U.LINE_STRIP)}else z.isPoints?ne.setMode(U.POINTS):z.isSprite&&ne.setMode(U.TRIANGLES);if(z.isBatchedMesh)if(oe.get("WEBGL_multi_draw"))ne.renderMultiDraw(z._multiDrawStarts,z._multiDrawCounts,z._multiDrawCount);else{let Ue=z._multiDrawStarts,bt=z._multiDrawCounts,Ve=z._multiDrawCount,Jt=xt?y.get(xt).bytesPerElement:1,Ni=Ct.get(B).currentProgram.getUniforms();for(let Fe=0;Fe<Ve;Fe++)Ni.setValue(U,"_gl_DrawID",Fe),ne.render(Ue[Fe]/Jt,bt[Fe])}else if(z.isInstancedMesh)ne.renderInstances(vt,ge,z.count);else if(H.isInstancedBufferGeometry){let Ue=H._maxInstanceCount!==void 0?H._maxInstanceCount:1/0,bt=Math.min(H.instanceCount,Ue);ne.renderInstances(vt,ge,bt)}else ne.render(vt,ge)};function Tu(v,L,H,B){N!==null&&v.isNodeMaterial&&N.setObject(B,v),_e===!0&&Z.setState(v,H,!1),v.transparent===!0&&v.side===Pe&&v.forceSinglePass===!1?(v.side=qe,v.needsUpdate=!0,sr(v,L,B),v.side=Ri,v.needsUpdate=!0,sr(v,L,B),v.side=Pe):sr(v,L,B)}this.compile=function(v,L,H=null){H===null&&(H=v),N!==null&&N.renderStart(v,L,H),S=$.get(H),S.init(L),w.push(S),H.traverseVisible(function(z){z.isLight&&z.layers.test(L.layers)&&(S.pushLight(z),z.castShadow&&S.pushShadow(z))}),v!==H&&v.traverseVisible(function(z){z.isLight&&z.layers.test(L.layers)&&(S.pushLight(z),z.castShadow&&S.pushShadow(z))}),S.setupLights(),N!==null&&N.updateLights(S.state.lightsArray),Je=this.localClippingEnabled,_e=Z.init(this.clippingPlanes,Je),_e===!0&&Z.setGlobalState(this.clippingPlanes,L),N!==null&&ot.render(S.state.shadowsArray,H,L);let B=new Set;return v.traverse(function(z){if(!(z.isMesh||z.isPoints||z.isLine||z.isSprite))return;let ut=z.material;if(ut)if(Array.isArray(ut))for(let _t=0;_t<ut.length;_t++){let ct=ut[_t];Tu(ct,H,L,z),B.add(ct)}else Tu(ut,H,L,z),B.add(ut)}),S=w.pop(),N!==null&&N.renderEnd(),B},this.compileAsync=function(v,L,H=null){let B=this.compile(v,L,H);return new Promise(z=>{function ut(){if(B.forEach(function(_t){let xt=Ct.get(_t).currentProgram;(xt===void 0||xt.isReady())&&B.delete(_t)}),B.size===0){z(v);return}setTimeout(ut,10)}oe.get("KHR_parallel_shader_compile")!==null?ut():setTimeout(ut,10)})};let uc=null;function Wg(v){uc&&uc(v)}function Eu(){Li.stop()}function Cu(){Li.start()}let Li=new Wm;Li.setAnimationLoop(Wg),typeof self<"u"&&Li.setContext(self),this.setAnimationLoop=function(v){uc=v,it.setAnimationLoop(v),v===null?Li.stop():Li.start()},it.addEventListener("sessionstart",Eu),it.addEventListener("sessionend",Cu),this.render=function(v,L){if(L!==void 0&&L.isCamera!==!0){Pt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(D===!0)return;N!==null&&N.renderStart(v,L);let H=it.enabled===!0&&it.isPresenting===!0,B=O!==null&&(tt===null||H)&&O.begin(P,tt);if(v.matrixWorldAutoUpdate===!0&&v.updateMatrixWorld(),L.parent===null&&L.matrixWorldAutoUpdate===!0&&L.updateMatrixWorld(),it.enabled===!0&&it.isPresenting===!0&&(O===null||O.isCompositing()===!1)&&(it.cameraAutoUpdate===!0&&it.updateCamera(L),L=it.getCamera()),v.isScene===!0&&v.onBeforeRender(P,v,L,tt),S=$.get(v,w.length),S.init(L),S.state.textureUnits=Nt.getTextureUnits(),w.push(S),ce.multiplyMatrices(L.projectionMatrix,L.matrixWorldInverse),L.isArrayCamera?Ce.setFromArrayCamera(L):Gt.setFromProjectionMatrix(ce,_n,L.reversedDepth),Je=this.localClippingEnabled,_e=Z.init(this.clippingPlanes,Je),E=ht.get(v,x.length),E.init(),x.push(E),this.info.render.frame++,it.enabled===!0&&it.isPresenting===!0){let _t=P.xr.getDepthSensingMesh();_t!==null&&fc(_t,L,-1/0,P.sortObjects)}fc(v,L,0,P.sortObjects),E.finish(),N!==null&&N.updateLights(S.state.lightsArray),P.sortObjects===!0&&E.sort(Ft,me),un=it.enabled===!1||it.isPresenting===!1||it.hasDepthSensing()===!1,un&&R.addToRenderList(E,v),this.info.autoReset===!0&&this.info.reset(),_e===!0&&Z.beginShadows();let z=S.state.shadowsArray;if(ot.render(z,v,L),_e===!0&&Z.endShadows(),(B&&O.hasRenderPass())===!1){let _t=E.opaque,ct=E.transmissive;if(S.setupLights(),L.isArrayCamera){let xt=L.cameras;if(ct.length>0)for(let St=0,Ut=xt.length;St<Ut;St++){let Ht=xt[St];Iu(_t,ct,v,Ht)}un&&R.render(v);for(let St=0,Ut=xt.length;St<Ut;St++){let Ht=xt[St];Ru(E,v,Ht,Ht.viewport)}}else ct.length>0&&Iu(_t,ct,v,L),un&&R.render(v),Ru(E,v,L)}tt!==null&&G===0&&(Nt.updateMultisampleRenderTarget(tt),Nt.updateRenderTargetMipmap(tt)),B&&O.end(P),v.isScene===!0&&v.onAfterRender(P,v,L),at.resetDefaultState(),X=-1,j=null,w.pop(),w.length>0?(S=w[w.length-1],Nt.setTextureUnits(S.state.textureUnits),_e===!0&&Z.setGlobalState(P.clippingPlanes,S.state.camera)):S=null,x.pop(),x.length>0?E=x[x.length-1]:E=null,N!==null&&N.renderEnd()};function fc(v,L,H,B){if(v.visible===!1)return;if(v.layers.test(L.layers)){if(v.isGroup)H=v.renderOrder;else if(v.isLOD)v.autoUpdate===!0&&v.update(L);else if(v.isLight)S.pushLight(v),v.castShadow&&S.pushShadow(v);else if(v.isSprite){let _t=L.isArrayCamera?Ce:Gt;if(!v.frustumCulled||v.intersectsFrustum(_t)){B&&Se.setFromMatrixPosition(v.matrixWorld).applyMatrix4(ce);let ct=nt.update(v),xt=v.material;xt.visible&&E.push(v,ct,xt,H,Se.z,null,L)}}else if(v.isMesh||v.isLine||v.isPoints){let _t=L.isArrayCamera?Ce:Gt;if(!v.frustumCulled||v.intersectsFrustum(_t)){let ct=nt.update(v),xt=v.material;if(B&&(v.boundingSphere!==void 0?(v.boundingSphere===null&&v.computeBoundingSphere(),Se.copy(v.boundingSphere.center)):(ct.boundingSphere===null&&ct.computeBoundingSphere(),Se.copy(ct.boundingSphere.center)),Se.applyMatrix4(v.matrixWorld).applyMatrix4(ce)),Array.isArray(xt)){let St=ct.groups;for(let Ut=0,Ht=St.length;Ut<Ht;Ut++){let vt=St[Ut],Wt=xt[vt.materialIndex];Wt&&Wt.visible&&E.push(v,ct,Wt,H,Se.z,vt,L)}}else xt.visible&&E.push(v,ct,xt,H,Se.z,null,L)}}}let ut=v.children;for(let _t=0,ct=ut.length;_t<ct;_t++)fc(ut[_t],L,H,B)}function Ru(v,L,H,B){let{opaque:z,transmissive:ut,transparent:_t}=v;S.setupLightsView(H),_e===!0&&Z.setGlobalState(P.clippingPlanes,H),B&&dt.viewport(et.copy(B)),z.length>0&&ra(z,L,H),ut.length>0&&ra(ut,L,H),_t.length>0&&ra(_t,L,H),dt.buffers.depth.setTest(!0),dt.buffers.depth.setMask(!0),dt.buffers.color.setMask(!0),dt.setPolygonOffset(!1)}function Iu(v,L,H,B){if((H.isScene===!0?H.overrideMaterial:null)!==null)return;if(S.state.transmissionRenderTarget[B.id]===void 0){let vt=oe.has("EXT_color_buffer_half_float")||oe.has("EXT_color_buffer_float");S.state.transmissionRenderTarget[B.id]=new Ie(1,1,{generateMipmaps:!0,type:vt?In:$e,minFilter:si,samples:Math.max(4,le.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:qt.workingColorSpace})}let ut=S.state.transmissionRenderTarget[B.id],_t=B.viewport||et;ut.setSize(_t.z*P.transmissionResolutionScale,_t.w*P.transmissionResolutionScale);let ct=P.getRenderTarget(),xt=P.getActiveCubeFace(),St=P.getActiveMipmapLevel();P.setRenderTarget(ut),P.getClearColor(J),mt=P.getClearAlpha(),mt<1&&P.setClearColor(16777215,.5),P.clear(),un&&R.render(H);let Ut=P.toneMapping;P.toneMapping=Hn;let Ht=B.viewport;if(B.viewport!==void 0&&(B.viewport=void 0),S.setupLightsView(B),_e===!0&&Z.setGlobalState(P.clippingPlanes,B),ra(v,H,B),Nt.updateMultisampleRenderTarget(ut),Nt.updateRenderTargetMipmap(ut),oe.has("WEBGL_multisampled_render_to_texture")===!1){let vt=!1;for(let Wt=0,ge=L.length;Wt<ge;Wt++){let se=L[Wt],{object:ne,geometry:Ue,material:bt,group:Ve}=se;if(bt.side===Pe&&ne.layers.test(B.layers)){let Jt=bt.side;bt.side=qe,bt.needsUpdate=!0,Pu(ne,H,B,Ue,bt,Ve),bt.side=Jt,bt.needsUpdate=!0,vt=!0}}vt===!0&&(Nt.updateMultisampleRenderTarget(ut),Nt.updateRenderTargetMipmap(ut))}P.setRenderTarget(ct,xt,St),P.setClearColor(J,mt),Ht!==void 0&&(B.viewport=Ht),P.toneMapping=Ut}function ra(v,L,H){let B=L.isScene===!0?L.overrideMaterial:null;for(let z=0,ut=v.length;z<ut;z++){let _t=v[z],{object:ct,geometry:xt,group:St}=_t,Ut=_t.material;Ut.allowOverride===!0&&B!==null&&(Ut=B),ct.layers.test(H.layers)&&Pu(ct,L,H,xt,Ut,St)}}function Pu(v,L,H,B,z,ut){N!==null&&z.isNodeMaterial&&N.setObject(v,z),v.onBeforeRender(P,L,H,B,z,ut),v.modelViewMatrix.multiplyMatrices(H.matrixWorldInverse,v.matrixWorld),v.normalMatrix.getNormalMatrix(v.modelViewMatrix),z.onBeforeRender(P,L,H,B,v,ut),z.transparent===!0&&z.side===Pe&&z.forceSinglePass===!1?(z.side=qe,z.needsUpdate=!0,P.renderBufferDirect(H,L,B,z,v,ut),z.side=Ri,z.needsUpdate=!0,P.renderBufferDirect(H,L,B,z,v,ut),z.side=Pe):P.renderBufferDirect(H,L,B,z,v,ut),v.onAfterRender(P,L,H,B,z,ut)}function Lu(v){let L=0;for(let H of v)H.texture!==null&&L++;return L}function sr(v,L,H){L.isScene!==!0&&(L=hn);let B=Ct.get(v),z=S.state.lights,ut=S.state.shadowsArray,_t=z.state.version,ct=Q.getParameters(v,z.state,ut,L,H,S.state.lightProbeGridArray),xt=Q.getProgramCacheKey(ct),St=B.programs;B.environment=v.isMeshStandardMaterial||v.isMeshLambertMaterial||v.isMeshPhongMaterial?L.environment:null,B.fog=L.fog;let Ut=v.isMeshStandardMaterial||v.isMeshLambertMaterial&&!v.envMap||v.isMeshPhongMaterial&&!v.envMap;B.envMap=T.get(v.envMap||B.environment,Ut),B.envMapRotation=B.environment!==null&&v.envMap===null?L.environmentRotation:v.envMapRotation,St===void 0&&(v.addEventListener("dispose",te),St=new Map,B.programs=St,B.programVariants=new Map);let Ht=St.get(xt);if(Ht!==void 0){if(B.currentProgram===Ht&&B.lightsStateVersion===_t)return Du(v,ct),Ht}else ct.uniforms=Q.getUniforms(v),N!==null&&v.isNodeMaterial&&N.build(v,H,ct),v.onBeforeCompile(ct,P),Ht=Q.acquireProgram(ct,xt),St.set(xt,Ht),B.uniforms=ct.uniforms;let vt=B.uniforms;return(!v.isShaderMaterial&&!v.isRawShaderMaterial||v.clipping===!0)&&(vt.clippingPlanes=Z.uniform),Du(v,ct),B.needsLights=Yg(v),B.lightsStateVersion=_t,B.needsLights&&(vt.ambientLightColor.value=z.state.ambient,vt.lightProbe.value=z.state.probe,vt.sunLights.value=z.state.sun,vt.sunLightShadows.value=z.state.sunShadow,vt.directionalLights.value=z.state.directional,vt.directionalLightShadows.value=z.state.directionalShadow,vt.spotLights.value=z.state.spot,vt.spotLightShadows.value=z.state.spotShadow,vt.rectAreaLights.value=z.state.rectArea,vt.ltc_1.value=z.state.rectAreaLTC1,vt.ltc_2.value=z.state.rectAreaLTC2,vt.pointLights.value=z.state.point,vt.pointLightShadows.value=z.state.pointShadow,vt.hemisphereLights.value=z.state.hemi,vt.sunShadowMatrix.value=z.state.sunShadowMatrix,vt.sunShadowCascade.value=z.state.sunShadowCascade,vt.directionalShadowMatrix.value=z.state.directionalShadowMatrix,vt.spotLightMatrix.value=z.state.spotLightMatrix,vt.spotLightMap.value=z.state.spotLightMap,vt.pointShadowMatrix.value=z.state.pointShadowMatrix),B.numLightProbeGrids=Lu(S.state.lightProbeGridArray),B.currentProgram=Ht,B.uniformsList=null,Ht}function Xg(v,L,H,B,z){let ut=Ct.get(v),_t=ut.currentProgram.id+","+B+","+z,ct=ut.programVariants.get(_t);return ct===void 0?(ct=sr(v,L,H),ut.programVariants.set(_t,ct)):(ut.currentProgram=ct,ut.uniformsList=null,ut.outputColorSpace=B,ut.toneMapping=z),ct}function Nu(v){if(v.uniformsList===null){let L=v.currentProgram.getUniforms();v.uniformsList=Ks.seqWithValue(L.seq,v.uniforms)}return v.uniformsList}function Du(v,L){let H=Ct.get(v);H.outputColorSpace=L.outputColorSpace,H.batching=L.batching,H.batchingColor=L.batchingColor,H.instancing=L.instancing,H.instancingColor=L.instancingColor,H.instancingMorph=L.instancingMorph,H.skinning=L.skinning,H.morphTargets=L.morphTargets,H.morphNormals=L.morphNormals,H.morphColors=L.morphColors,H.morphTargetsCount=L.morphTargetsCount,H.numClippingPlanes=L.numClippingPlanes,H.numIntersection=L.numClipIntersection,H.vertexAlphas=L.vertexAlphas,H.vertexTangents=L.vertexTangents,H.toneMapping=L.toneMapping}function qg(v,L,H,B,z){L.isScene!==!0&&(L=hn),Nt.resetTextureUnits();let ut=L.fog,_t=B.isMeshStandardMaterial||B.isMeshLambertMaterial||B.isMeshPhongMaterial?L.environment:null,ct=tt===null?P.outputColorSpace:tt.isXRRenderTarget===!0?tt.texture.colorSpace:qt.workingColorSpace,xt=B.isMeshStandardMaterial||B.isMeshLambertMaterial&&!B.envMap||B.isMeshPhongMaterial&&!B.envMap,St=T.get(B.envMap||_t,xt),Ut=B.vertexColors===!0&&!!H.attributes.color&&H.attributes.color.itemSize===4,Ht=!!H.attributes.tangent&&(!!B.normalMap||B.anisotropy>0),vt=!!H.morphAttributes.position,Wt=!!H.morphAttributes.normal,ge=!!H.morphAttributes.color,se=Hn;B.toneMapped&&(tt===null||tt.isXRRenderTarget===!0)&&(se=P.toneMapping);let ne=H.morphAttributes.position||H.morphAttributes.normal||H.morphAttributes.color,Ue=ne!==void 0?ne.length:0,bt=Ct.get(B),Ve=S.state.lights;if(_e===!0&&(Je===!0||v!==j)){let he=v===j&&B.id===X;Z.setState(B,v,he)}let Jt=!1,Ni=!1;B.version===bt.__version?bt.needsLights&&bt.lightsStateVersion!==Ve.state.version||z.isBatchedMesh&&bt.batching===!1||!z.isBatchedMesh&&bt.batching===!0||z.isBatchedMesh&&bt.batchingColor===!0&&z._colorsTexture===null||z.isBatchedMesh&&bt.batchingColor===!1&&z._colorsTexture!==null||z.isInstancedMesh&&bt.instancing===!1||!z.isInstancedMesh&&bt.instancing===!0||z.isSkinnedMesh&&bt.skinning===!1||!z.isSkinnedMesh&&bt.skinning===!0||z.isInstancedMesh&&bt.instancingColor===!0&&z.instanceColor===null||z.isInstancedMesh&&bt.instancingColor===!1&&z.instanceColor!==null||z.isInstancedMesh&&bt.instancingMorph===!0&&z.morphTexture===null||z.isInstancedMesh&&bt.instancingMorph===!1&&z.morphTexture!==null||bt.envMap!==St||B.fog===!0&&bt.fog!==ut||bt.numClippingPlanes!==void 0&&(bt.numClippingPlanes!==Z.numPlanes||bt.numIntersection!==Z.numIntersection)||bt.vertexAlphas!==Ut||bt.vertexTangents!==Ht||bt.morphTargets!==vt||bt.morphNormals!==Wt||bt.morphColors!==ge||bt.morphTargetsCount!==Ue||bt.numLightProbeGrids!==Lu(S.state.lightProbeGridArray)?Jt=!0:(bt.outputColorSpace!==ct||bt.toneMapping!==se)&&(Ni=!0):(Jt=!0,bt.__version=B.version);let Fe=bt.currentProgram;(Jt===!0||Ni===!0)&&(Fe=Ni===!0?Xg(B,L,z,ct,se):sr(B,L,z),N&&B.isNodeMaterial&&N.onUpdateProgram(B,Fe,bt));let aa=!1,li=!1,Di=!1,Zt=Fe.getUniforms(),Re=bt.uniforms;if(dt.useProgram(Fe.program)&&(aa=!0,li=!0,Di=!0),B.id!==X&&(X=B.id,li=!0),aa||j!==v){dt.buffers.depth.getReversed()&&v.reversedDepth!==!0&&(v._reversedDepth=!0,v.updateProjectionMatrix()),Zt.setValue(U,"projectionMatrix",v.projectionMatrix),Zt.setValue(U,"viewMatrix",v.matrixWorldInverse);let Ae=Zt.map.cameraPosition;Ae!==void 0&&Ae.setValue(U,Pn.setFromMatrixPosition(v.matrixWorld)),le.logarithmicDepthBuffer&&Zt.setValue(U,"logDepthBufFC",2/(Math.log(v.far+1)/Math.LN2)),(B.isMeshPhongMaterial||B.isMeshToonMaterial||B.isMeshLambertMaterial||B.isMeshBasicMaterial||B.isMeshStandardMaterial||B.isShaderMaterial)&&Zt.setValue(U,"isOrthographic",v.isOrthographicCamera===!0),j!==v&&(j=v,li=!0,Di=!0)}if(bt.needsLights&&(Ve.state.sunShadowMap.length>0&&Zt.setValue(U,"sunShadowMap",Ve.state.sunShadowMap,Nt),Ve.state.directionalShadowMap.length>0&&Zt.setValue(U,"directionalShadowMap",Ve.state.directionalShadowMap,Nt),Ve.state.spotShadowMap.length>0&&Zt.setValue(U,"spotShadowMap",Ve.state.spotShadowMap,Nt),Ve.state.pointShadowMap.length>0&&Zt.setValue(U,"pointShadowMap",Ve.state.pointShadowMap,Nt)),z.isSkinnedMesh){Zt.setOptional(U,z,"bindMatrix"),Zt.setOptional(U,z,"bindMatrixInverse");let he=z.skeleton;he&&(he.boneTexture===null&&he.computeBoneTexture(),Zt.setValue(U,"boneTexture",he.boneTexture,Nt))}z.isBatchedMesh&&(Zt.setOptional(U,z,"batchingTexture"),Zt.setValue(U,"batchingTexture",z._matricesTexture,Nt),Zt.setOptional(U,z,"batchingIdTexture"),Zt.setValue(U,"batchingIdTexture",z._indirectTexture,Nt),Zt.setOptional(U,z,"batchingColorTexture"),z._colorsTexture!==null&&Zt.setValue(U,"batchingColorTexture",z._colorsTexture,Nt));let vn=H.morphAttributes;if((vn.position!==void 0||vn.normal!==void 0||vn.color!==void 0)&&K.update(z,H,Fe),(li||bt.receiveShadow!==z.receiveShadow)&&(bt.receiveShadow=z.receiveShadow,Zt.setValue(U,"receiveShadow",z.receiveShadow)),(B.isMeshStandardMaterial||B.isMeshLambertMaterial||B.isMeshPhongMaterial)&&B.envMap===null&&L.environment!==null&&(Re.envMapIntensity.value=L.environmentIntensity),Re.dfgLUT!==void 0&&(Re.dfgLUT.value=d1()),li){if(Zt.setValue(U,"toneMappingExposure",P.toneMappingExposure),bt.needsLights&&$g(Re,Di),ut&&B.fog===!0&&rt.refreshFogUniforms(Re,ut),rt.refreshMaterialUniforms(Re,B,gt,Et,S.state.transmissionRenderTarget[v.id]),bt.needsLights&&bt.numLightProbeGrids>0){let he=b,Ae=0;for(let Yn of S.state.lightProbeGridArray)Yn.texture!==null&&(he.textures[Ae]=Yn.texture,he.min[Ae]=Yn.boundingBox.min,he.max[Ae]=Yn.boundingBox.max,he.resolution[Ae]=Yn.resolution,Ae++);for(let Yn in he)he[Yn].length=Ae;Re.probesSH.value=he.textures,Re.probesMin.value=he.min,Re.probesMax.value=he.max,Re.probesResolution.value=he.resolution}Ks.upload(U,Nu(bt),Re,Nt)}if(B.isShaderMaterial&&B.uniformsNeedUpdate===!0&&(Ks.upload(U,Nu(bt),Re,Nt),B.uniformsNeedUpdate=!1),B.isSpriteMaterial&&Zt.setValue(U,"center",z.center),Zt.setValue(U,"modelViewMatrix",z.modelViewMatrix),Zt.setValue(U,"normalMatrix",z.normalMatrix),Zt.setValue(U,"modelMatrix",z.matrixWorld),B.uniformsGroups!==void 0){let he=B.uniformsGroups;for(let Ae=0,Yn=he.length;Ae<Yn;Ae++){let Fu=he[Ae];wt.update(Fu,Fe),wt.bind(Fu,Fe)}}return Fe}function $g(v,L){v.ambientLightColor.needsUpdate=L,v.lightProbe.needsUpdate=L,v.sunLights.needsUpdate=L,v.sunLightShadows.needsUpdate=L,v.directionalLights.needsUpdate=L,v.directionalLightShadows.needsUpdate=L,v.pointLights.needsUpdate=L,v.pointLightShadows.needsUpdate=L,v.spotLights.needsUpdate=L,v.spotLightShadows.needsUpdate=L,v.rectAreaLights.needsUpdate=L,v.hemisphereLights.needsUpdate=L}function Yg(v){return v.isMeshLambertMaterial||v.isMeshToonMaterial||v.isMeshPhongMaterial||v.isMeshStandardMaterial||v.isShadowMaterial||v.isShaderMaterial&&v.lights===!0}this.getActiveCubeFace=function(){return Y},this.getActiveMipmapLevel=function(){return G},this.getRenderTarget=function(){return tt},this.setRenderTargetTextures=function(v,L,H){let B=Ct.get(v);B.__autoAllocateDepthBuffer=v.resolveDepthBuffer===!1,B.__autoAllocateDepthBuffer===!1&&(B.__useRenderToTexture=!1),Ct.get(v.texture).__webglTexture=L,Ct.get(v.depthTexture).__webglTexture=B.__autoAllocateDepthBuffer?void 0:H,B.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(v,L){let H=Ct.get(v);H.__webglFramebuffer=L,H.__useDefaultFramebuffer=L===void 0},this.setRenderTarget=function(v,L=0,H=0){tt=v,Y=L,G=H;let B=null,z=!1,ut=!1;if(v){let ct=Ct.get(v);if(ct.__useDefaultFramebuffer!==void 0){dt.bindFramebuffer(U.FRAMEBUFFER,ct.__webglFramebuffer),et.copy(v.viewport),Mt.copy(v.scissor),Dt=v.scissorTest,dt.viewport(et),dt.scissor(Mt),dt.setScissorTest(Dt),X=-1;return}else if(ct.__webglFramebuffer===void 0)Nt.setupRenderTarget(v);else if(ct.__hasExternalTextures)Nt.rebindTextures(v,Ct.get(v.texture).__webglTexture,Ct.get(v.depthTexture).__webglTexture);else if(v.depthBuffer){let Ut=v.depthTexture;if(ct.__boundDepthTexture!==Ut){if(Ut!==null&&Ct.has(Ut)&&(v.width!==Ut.image.width||v.height!==Ut.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Nt.setupDepthRenderbuffer(v)}}let xt=v.texture;(xt.isData3DTexture||xt.isDataArrayTexture||xt.isCompressedArrayTexture)&&(ut=!0);let St=Ct.get(v).__webglFramebuffer;v.isWebGLCubeRenderTarget?(Array.isArray(St[L])?B=St[L][H]:B=St[L],z=!0):v.samples>0&&Nt.useMultisampledRTT(v)===!1?B=Ct.get(v).__webglMultisampledFramebuffer:Array.isArray(St)?B=St[H]:B=St,et.copy(v.viewport),Mt.copy(v.scissor),Dt=v.scissorTest}else et.copy(It).multiplyScalar(gt).floor(),Mt.copy(Qt).multiplyScalar(gt).floor(),Dt=ee;if(H!==0&&(B=V),dt.bindFramebuffer(U.FRAMEBUFFER,B)&&dt.drawBuffers(v,B),dt.viewport(et),dt.scissor(Mt),dt.setScissorTest(Dt),z){let ct=Ct.get(v.texture);U.framebufferTexture2D(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_CUBE_MAP_POSITIVE_X+L,ct.__webglTexture,H)}else if(ut){let ct=L;for(let xt=0;xt<v.textures.length;xt++){let St=Ct.get(v.textures[xt]);U.framebufferTextureLayer(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0+xt,St.__webglTexture,H,ct)}}else if(v!==null&&H!==0){let ct=Ct.get(v.texture);U.framebufferTexture2D(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,ct.__webglTexture,H)}X=-1};function Uu(v){let L=Ct.get(v);return(L.__readFormat!==v.format||L.__readType!==v.type)&&(L.__readFormat=v.format,L.__readType=v.type,L.__formatReadable=le.textureFormatReadable(v.format),L.__typeReadable=le.textureTypeReadable(v.type)),L}this.readRenderTargetPixels=function(v,L,H,B,z,ut,_t,ct=0){if(!(v&&v.isWebGLRenderTarget)){Pt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let xt=Ct.get(v).__webglFramebuffer;if(v.isWebGLCubeRenderTarget&&_t!==void 0&&(xt=xt[_t],Array.isArray(xt)&&(xt=xt[0])),xt){dt.bindFramebuffer(U.FRAMEBUFFER,xt);try{let St=v.textures[ct],Ut=St.format,Ht=St.type;v.textures.length>1&&U.readBuffer(U.COLOR_ATTACHMENT0+ct);let vt=Uu(St);if(vt.__formatReadable===!1){Pt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(vt.__typeReadable===!1){Pt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}L>=0&&L<=v.width-B&&H>=0&&H<=v.height-z&&U.readPixels(L,H,B,z,st.convert(Ut),st.convert(Ht),ut)}finally{let St=tt!==null?Ct.get(tt).__webglFramebuffer:null;dt.bindFramebuffer(U.FRAMEBUFFER,St)}}},this.readRenderTargetPixelsAsync=async function(v,L,H,B,z,ut,_t,ct=0){if(!(v&&v.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let xt=Ct.get(v).__webglFramebuffer;if(v.isWebGLCubeRenderTarget&&_t!==void 0&&(xt=xt[_t],Array.isArray(xt)&&(xt=xt[0])),xt)if(L>=0&&L<=v.width-B&&H>=0&&H<=v.height-z){dt.bindFramebuffer(U.FRAMEBUFFER,xt);let St=v.textures[ct],Ut=St.format,Ht=St.type;v.textures.length>1&&U.readBuffer(U.COLOR_ATTACHMENT0+ct);let vt=Uu(St);if(vt.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(vt.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let Wt=U.createBuffer();U.bindBuffer(U.PIXEL_PACK_BUFFER,Wt),U.bufferData(U.PIXEL_PACK_BUFFER,ut.byteLength,U.STREAM_READ),U.readPixels(L,H,B,z,st.convert(Ut),st.convert(Ht),0),U.bindBuffer(U.PIXEL_PACK_BUFFER,null);let ge=tt!==null?Ct.get(tt).__webglFramebuffer:null;dt.bindFramebuffer(U.FRAMEBUFFER,ge);let se=U.fenceSync(U.SYNC_GPU_COMMANDS_COMPLETE,0);return U.flush(),await _m(U,se,4),U.bindBuffer(U.PIXEL_PACK_BUFFER,Wt),U.getBufferSubData(U.PIXEL_PACK_BUFFER,0,ut),U.bindBuffer(U.PIXEL_PACK_BUFFER,null),U.deleteBuffer(Wt),U.deleteSync(se),ut}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(v,L=null,H=0){let B=Math.pow(2,-H),z=Math.floor(v.image.width*B),ut=Math.floor(v.image.height*B),_t=L!==null?L.x:0,ct=L!==null?L.y:0;Nt.setTexture2D(v,0),U.copyTexSubImage2D(U.TEXTURE_2D,H,0,0,_t,ct,z,ut),dt.unbindTexture()},this.copyTextureToTexture=function(v,L,H=null,B=null,z=0,ut=0){let _t,ct,xt,St,Ut,Ht,vt,Wt,ge,se=v.isCompressedTexture?v.mipmaps[ut]:v.image;if(H!==null)_t=H.max.x-H.min.x,ct=H.max.y-H.min.y,xt=H.isBox3?H.max.z-H.min.z:1,St=H.min.x,Ut=H.min.y,Ht=H.isBox3?H.min.z:0;else{let Zt=Math.pow(2,-z);_t=Math.floor(se.width*Zt),ct=Math.floor(se.height*Zt),v.isDataArrayTexture?xt=se.depth:v.isData3DTexture?xt=Math.floor(se.depth*Zt):xt=1,St=0,Ut=0,Ht=0}B!==null?(vt=B.x,Wt=B.y,ge=B.z):(vt=0,Wt=0,ge=0);let ne=st.convert(L.format),Ue=st.convert(L.type),bt;L.isData3DTexture?(Nt.setTexture3D(L,0),bt=U.TEXTURE_3D):L.isDataArrayTexture||L.isCompressedArrayTexture?(Nt.setTexture2DArray(L,0),bt=U.TEXTURE_2D_ARRAY):(Nt.setTexture2D(L,0),bt=U.TEXTURE_2D),dt.activeTexture(U.TEXTURE0),dt.pixelStorei(U.UNPACK_FLIP_Y_WEBGL,L.flipY),dt.pixelStorei(U.UNPACK_PREMULTIPLY_ALPHA_WEBGL,L.premultiplyAlpha),dt.pixelStorei(U.UNPACK_ALIGNMENT,L.unpackAlignment);let Ve=dt.getParameter(U.UNPACK_ROW_LENGTH),Jt=dt.getParameter(U.UNPACK_IMAGE_HEIGHT),Ni=dt.getParameter(U.UNPACK_SKIP_PIXELS),Fe=dt.getParameter(U.UNPACK_SKIP_ROWS),aa=dt.getParameter(U.UNPACK_SKIP_IMAGES);dt.pixelStorei(U.UNPACK_ROW_LENGTH,se.width),dt.pixelStorei(U.UNPACK_IMAGE_HEIGHT,se.height),dt.pixelStorei(U.UNPACK_SKIP_PIXELS,St),dt.pixelStorei(U.UNPACK_SKIP_ROWS,Ut),dt.pixelStorei(U.UNPACK_SKIP_IMAGES,Ht);let li=v.isDataArrayTexture||v.isData3DTexture,Di=L.isDataArrayTexture||L.isData3DTexture;if(v.isDepthTexture){let Zt=Ct.get(v),Re=Ct.get(L),vn=Ct.get(Zt.__renderTarget),he=Ct.get(Re.__renderTarget);dt.bindFramebuffer(U.READ_FRAMEBUFFER,vn.__webglFramebuffer),dt.bindFramebuffer(U.DRAW_FRAMEBUFFER,he.__webglFramebuffer);for(let Ae=0;Ae<xt;Ae++)li&&(U.framebufferTextureLayer(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,Ct.get(v).__webglTexture,z,Ht+Ae),U.framebufferTextureLayer(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,Ct.get(L).__webglTexture,ut,ge+Ae)),U.blitFramebuffer(St,Ut,St+_t,Ut+ct,vt,Wt,vt+_t,Wt+ct,U.DEPTH_BUFFER_BIT,U.NEAREST);dt.bindFramebuffer(U.READ_FRAMEBUFFER,null),dt.bindFramebuffer(U.DRAW_FRAMEBUFFER,null)}else if(z!==0||v.isRenderTargetTexture||Ct.has(v)){let Zt=Ct.get(v),Re=Ct.get(L);dt.bindFramebuffer(U.READ_FRAMEBUFFER,I),dt.bindFramebuffer(U.DRAW_FRAMEBUFFER,W);for(let vn=0;vn<xt;vn++)li?U.framebufferTextureLayer(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,Zt.__webglTexture,z,Ht+vn):U.framebufferTexture2D(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,Zt.__webglTexture,z),Di?U.framebufferTextureLayer(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,Re.__webglTexture,ut,ge+vn):U.framebufferTexture2D(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,Re.__webglTexture,ut),z!==0?U.blitFramebuffer(St,Ut,St+_t,Ut+ct,vt,Wt,vt+_t,Wt+ct,U.COLOR_BUFFER_BIT,U.NEAREST):Di?U.copyTexSubImage3D(bt,ut,vt,Wt,ge+vn,St,Ut,_t,ct):U.copyTexSubImage2D(bt,ut,vt,Wt,St,Ut,_t,ct);dt.bindFramebuffer(U.READ_FRAMEBUFFER,null),dt.bindFramebuffer(U.DRAW_FRAMEBUFFER,null)}else Di?v.isDataTexture||v.isData3DTexture?U.texSubImage3D(bt,ut,vt,Wt,ge,_t,ct,xt,ne,Ue,se.data):L.isCompressedArrayTexture?U.compressedTexSubImage3D(bt,ut,vt,Wt,ge,_t,ct,xt,ne,se.data):U.texSubImage3D(bt,ut,vt,Wt,ge,_t,ct,xt,ne,Ue,se):v.isDataTexture?U.texSubImage2D(U.TEXTURE_2D,ut,vt,Wt,_t,ct,ne,Ue,se.data):v.isCompressedTexture?U.compressedTexSubImage2D(U.TEXTURE_2D,ut,vt,Wt,se.width,se.height,ne,se.data):U.texSubImage2D(U.TEXTURE_2D,ut,vt,Wt,_t,ct,ne,Ue,se);dt.pixelStorei(U.UNPACK_ROW_LENGTH,Ve),dt.pixelStorei(U.UNPACK_IMAGE_HEIGHT,Jt),dt.pixelStorei(U.UNPACK_SKIP_PIXELS,Ni),dt.pixelStorei(U.UNPACK_SKIP_ROWS,Fe),dt.pixelStorei(U.UNPACK_SKIP_IMAGES,aa),ut===0&&L.generateMipmaps===!0&&L.mipmapsAutoUpdate===!0&&U.generateMipmap(bt),dt.unbindTexture()},this.initRenderTarget=function(v){Ct.get(v).__webglFramebuffer===void 0&&Nt.setupRenderTarget(v)},this.initTexture=function(v){v.isCubeTexture?Nt.setTextureCube(v,0):v.isData3DTexture?Nt.setTexture3D(v,0):v.isDataArrayTexture||v.isCompressedArrayTexture?Nt.setTexture2DArray(v,0):Nt.setTexture2D(v,0),dt.unbindTexture()},this.resetState=function(){Y=0,G=0,tt=null,dt.reset(),at.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return _n}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=qt._getDrawingBufferColorSpace(t),e.unpackColorSpace=qt._getUnpackColorSpace()}};var fu=`
  uniform vec3 light;
  uniform sampler2DShadow shadowMap;
  uniform mat4 shadowMatrix;
  uniform float shadowTexel;
  uniform bool shadowed;

  // Share of the light that arrives, from samples on a disc. Each pixel turns the disc by another angle.
  float lightAt(vec3 point, float radius, float bias, int taps) {
    if (!shadowed) return 1.0;
    vec3 place = (shadowMatrix * vec4(point, 1.0)).xyz;
    if (any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(1.0)))) return 1.0;
    if (taps == 1) return texture(shadowMap, vec3(place.xy, place.z - bias));
    float turn = 6.2832 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    float total = 0.0;
    for (int i = 0; i < taps; ++i) {
      float angle = float(i) * 2.39996 + turn, far = sqrt((float(i) + 0.5) / float(taps)) * radius * shadowTexel;
      total += texture(shadowMap, vec3(place.xy + far * vec2(cos(angle), sin(angle)), place.z - bias));
    }
    return total / float(taps);
  }

  vec3 lit(vec3 base, vec3 normal, vec3 toEye, float arriving, float through) {
    float facing = dot(normal, light);
    float direct = clamp((facing + 0.12) / 1.12, 0.0, 1.0) * (0.25 + 0.75 * arriving);
    float ambient = 0.34 + 0.10 * normal.z + 0.12 * dot(normal, toEye);
    float gloss = 0.10 * arriving * pow(clamp(dot(normal, normalize(light + toEye)), 0.0, 1.0), 24.0);
    return base * 0.92 * (ambient + 0.78 * direct + through * clamp(-facing, 0.0, 1.0)) + 0.6 * gloss;
  }
  vec4 shown(vec3 linear) { return vec4(pow(clamp(linear, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0); }
`,du=`
  out vec3 vPoint, vNormal;
  void main() {
    vPoint = (modelMatrix * vec4(position, 1.0)).xyz;
    vNormal = normal;
    gl_Position = projectionMatrix * viewMatrix * vec4(vPoint, 1.0);
  }
`;function eg(n){return{light:{value:new F(...n.light)},shadowMap:{value:null},shadowMatrix:{value:null},shadowTexel:{value:1},size:{value:1},taps:{value:8},shadowed:{value:!0}}}var Gl=(n,t,e,i={},s={})=>new pe({glslVersion:yn,uniforms:{...n,...i},vertexShader:t,fragmentShader:e,...s});function ng(n,t){return Gl(n,`
    in float value;
    out vec3 vPoint, vNormal, vCorner;
    out float vValue;
    void main() {
      vPoint = (modelMatrix * vec4(position, 1.0)).xyz;
      vNormal = normal;
      vValue = value;
      int corner = gl_VertexID % 3;
      vCorner = vec3(corner == 0, corner == 1, corner == 2);
      gl_Position = projectionMatrix * viewMatrix * vec4(vPoint, 1.0);
    }`,`
    ${fu}
    uniform sampler2D map;
    uniform vec2 range;
    uniform bool logarithmic, coloured, lines;
    uniform vec3 back, plain;
    uniform float size;
    uniform int taps;
    in vec3 vPoint, vNormal, vCorner;
    in float vValue;
    layout(location = 0) out vec4 colour;
    void main() {
      vec3 toEye = normalize(cameraPosition - vPoint);
      vec3 base = plain;
      if (coloured && vValue == vValue) {
        float share = logarithmic ? log(max(vValue, 1e-30) / range.x) / log(range.y / range.x)
                                  : (vValue - range.x) / (range.y - range.x);
        base = pow(texture(map, vec2(clamp(share, 0.0, 1.0) * (255.0 / 256.0) + 0.5 / 256.0, 0.5)).rgb, vec3(2.2));
      }
      vec3 normal = normalize(vNormal);
      if (!gl_FrontFacing) { normal = -normal; base *= back; }
      if (lines) {
        vec3 width = fwidth(vCorner);
        vec3 near = vCorner / max(width, 1e-6);
        float pixels = min(min(near.x, near.y), near.z);
        float strength = clamp((1.0 / max(max(width.x, width.y), width.z) - 5.0) / 18.0, 0.0, 1.0);
        base *= 1.0 - 0.32 * strength * clamp(1.1 - pixels, 0.0, 1.0);
      }
      float arriving = lightAt(vPoint + 0.006 * size * normal, 1.6, 0.002, taps);
      colour = shown(lit(base, normal, toEye, arriving, 0.22));
    }`,{map:{value:null},range:{value:null},logarithmic:{value:!1},coloured:{value:!1},lines:{value:!0},back:{value:new F(...t.back)},plain:{value:new F(...p1)}},{side:Pe})}function ig(n){let t=e=>e.replace(/\b(in|out) float vValue;/,"flat $1 float vValue;");return new pe({glslVersion:yn,side:Pe,uniforms:n.uniforms,vertexShader:t(n.vertexShader).replace(/(out vec3 vPoint, vNormal), vCorner;/,"$1;").replace(/int corner =[^;]*;\s*vCorner =[^;]*;/,""),fragmentShader:t(n.fragmentShader).replace(/(in vec3 vPoint, vNormal), vCorner;/,"$1;").replace(/if \(lines\) \{[^}]*\}/,"")})}var p1=[.8,.775,.715];function sg(n){return Gl(n,du,`
    uniform vec3 tint;
    in vec3 vPoint, vNormal;
    layout(location = 0) out vec4 colour;
    void main() {
      vec3 toEye = normalize(cameraPosition - vPoint);
      float edge = 1.0 - abs(dot(normalize(vNormal), toEye));
      colour = vec4(tint, 0.10 + 0.65 * edge * edge * edge);
    }`,{tint:{value:new F(.04,.37,.65)}},{side:Pe,transparent:!0,depthWrite:!1})}function rg(n,t){return Gl(n,du,`
    ${fu}
    uniform vec3 base;
    uniform float size;
    uniform int taps;
    in vec3 vPoint, vNormal;
    layout(location = 0) out vec4 colour;
    void main() {
      vec3 toEye = normalize(cameraPosition - vPoint);
      vec3 normal = normalize(cross(dFdx(vPoint), dFdy(vPoint)));
      vec3 smoothed = normalize(vNormal);
      if (dot(smoothed, toEye) < 0.0) smoothed = -smoothed;
      if (dot(normal, smoothed) > 0.5) normal = smoothed;
      if (dot(normal, toEye) < 0.0) normal = -normal;
      float arriving = lightAt(vPoint + 0.006 * size * normal, 1.6, 0.002, taps);
      colour = shown(lit(base, normal, toEye, arriving, 0.0));
    }`,{base:{value:new F(...t.obstacle.map(e=>e**2.2))}},{side:Pe})}function ag(n){return Gl(n,du,`
    ${fu}
    uniform float size;
    uniform vec3 middle;
    uniform int taps;
    in vec3 vPoint, vNormal;
    layout(location = 0) out vec4 colour;
    void main() {
      if (cameraPosition.z < vPoint.z) discard;
      float fade = clamp(1.0 - (length(vPoint.xy - middle.xy) / size - 1.2) / 1.3, 0.0, 1.0);
      float dark = 1.0 - lightAt(vPoint, 16.0, 0.0, taps == 1 ? 1 : taps * 2);
      colour = vec4(vec3(0.03, 0.04, 0.06), 0.26 * fade * dark);
    }`,{middle:{value:new F}},{transparent:!0,depthWrite:!1,side:Pe})}function og(){return new pe({glslVersion:yn,side:Pe,colorWrite:!1,vertexShader:"void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",fragmentShader:"layout(location = 0) out vec4 colour; void main() { colour = vec4(1.0); }"})}function lg(n){let t=new Uint8Array(1024).fill(255);for(let i=0;i<256;++i)for(let s=0;s<3;++s)t[4*i+s]=parseInt(n.substr(6*i+2*s,2),16);let e=new Ws(t,256,1,cn,$e);return e.minFilter=e.magFilter=fe,e.needsUpdate=!0,e}var Hl=class{constructor(t,e,i){this.mesh=t,this.positions=new Float32Array(3*t.vertexCount),this.normals=new Float32Array(3*t.vertexCount),this.material=ng(e,i),this.quickMaterial=ig(this.material),this.corners={fine:{vertices:t.triangles,drawn:null},quick:{drawn:null}};let s=new ve;s.setAttribute("position",new re(this.positions,3).setUsage(Kr)),s.setIndex(new re(t.triangles,1)),this.caster=cg(s,this.material),this.values=null,this.turn={}}use(t,e){let i=t?"quick":"fine",s=this.corners[i];s.drawn||(t&&Object.assign(s,g1(this.mesh)),s.drawn=cg(m1(s),t?this.quickMaterial:this.material),e.add(s.drawn));for(let r of Object.values(this.corners))r.drawn&&(r.drawn.visible=r===s);s.moved!==this.turn&&(s.moved=this.turn,hg(s,"position",this.positions),hg(s,"normal",this.normals)),s.coloured!==this.values&&(s.coloured=this.values,this.values&&this.#t(s,t))}moved(){pu(this.positions,this.mesh.triangles,this.normals);for(let t of Object.values(this.caster.geometry.attributes))t.needsUpdate=!0;this.turn={}}get shared(){let{geometry:t}=this.caster;return t.getAttribute("normal")||t.setAttribute("normal",new re(this.normals,3).setUsage(Kr)),t}colour(t,e=!1){this.material.uniforms.coloured.value=!!t,this.values=t?{values:t,smooth:e}:null}#t(t,e){let{values:i,smooth:s}=this.values,{triangles:r}=this.mesh,a=t.drawn.geometry.getAttribute("value"),o=a.array;if(e)for(let l=0;l<this.mesh.triangleCount;++l)o[l]=s?(i[r[3*l]]+i[r[3*l+1]]+i[r[3*l+2]])/3:i[l];else if(s)for(let l=0;l<o.length;++l)o[l]=i[r[l]];else for(let l=0;l<o.length;++l)o[l]=i[l/3|0];a.needsUpdate=!0}dispose(){for(let{drawn:t}of Object.values(this.corners))t?.geometry.dispose();this.caster.geometry.dispose(),this.material.dispose(),this.quickMaterial.dispose()}};function cg(n,t){n.boundingSphere=new an(new F,1/0);let e=new de(n,t);return e.frustumCulled=!1,e}function m1({vertices:n,index:t}){let e=new ve;for(let[i,s]of[["position",3],["normal",3],["value",1]])e.setAttribute(i,new re(new Float32Array(s*n.length),s).setUsage(Kr));return t&&e.setIndex(new re(t,1)),e}function g1({triangles:n,triangleCount:t,vertexCount:e}){let i=new Uint32Array(t),s=new Int32Array(e).fill(-1);for(let o=0;o<t;++o){let l=0;for(;l<2&&s[n[3*o+l]]>=0;)++l;i[o]=l,s[n[3*o+l]]<0&&(s[n[3*o+l]]=o)}let r=Array.from(i,(o,l)=>n[3*l+o]);s.forEach((o,l)=>{o<0&&(s[l]=r.push(l)-1)});let a=new Uint32Array(3*t);for(let o=0;o<t;++o)a[3*o]=s[n[3*o+(i[o]+1)%3]],a[3*o+1]=s[n[3*o+(i[o]+2)%3]],a[3*o+2]=o;return{vertices:Uint32Array.from(r),index:a}}function hg({vertices:n,drawn:t},e,i){let s=t.geometry.getAttribute(e),r=s.array;for(let a=0,o=0;a<n.length;++a,o+=3){let l=3*n[a];r[o]=i[l],r[o+1]=i[l+1],r[o+2]=i[l+2]}s.needsUpdate=!0}function pu(n,t,e){e.fill(0);for(let i=0;i<t.length;i+=3){let s=3*t[i],r=3*t[i+1],a=3*t[i+2],o=n[r]-n[s],l=n[r+1]-n[s+1],c=n[r+2]-n[s+2],h=n[a]-n[s],f=n[a+1]-n[s+1],u=n[a+2]-n[s+2],d=l*u-c*f,m=c*h-o*u,_=o*f-l*h;e[s]+=d,e[s+1]+=m,e[s+2]+=_,e[r]+=d,e[r+1]+=m,e[r+2]+=_,e[a]+=d,e[a+1]+=m,e[a+2]+=_}for(let i=0;i<e.length;i+=3){let s=Math.sqrt(e[i]**2+e[i+1]**2+e[i+2]**2)||1;e[i]/=s,e[i+1]/=s,e[i+2]/=s}}function ug(n,t,e,i){let s=null;for(let r=0;r<i.length;r+=3){let a=3*i[r],o=3*i[r+1],l=3*i[r+2],c=e[o]-e[a],h=e[o+1]-e[a+1],f=e[o+2]-e[a+2],u=e[l]-e[a],d=e[l+1]-e[a+1],m=e[l+2]-e[a+2],_=t[1]*m-t[2]*d,p=t[2]*u-t[0]*m,g=t[0]*d-t[1]*u,M=c*_+h*p+f*g;if(M===0)continue;let A=n[0]-e[a],b=n[1]-e[a+1],E=n[2]-e[a+2],S=(A*_+b*p+E*g)/M;if(S<0||S>1)continue;let x=b*f-E*h,w=E*c-A*f,O=A*h-b*c,P=(t[0]*x+t[1]*w+t[2]*O)/M;if(P<0||S+P>1)continue;let D=(u*x+d*w+m*O)/M;D>0&&(!s||D<s.far)&&(s={triangle:r/3,far:D,shares:[1-S-P,S,P]})}return s}function Qs(n,t,e){let{inverse:i}=n.frames,{triangles:s}=n,r=i[4*e],a=i[4*e+2],o=i[4*e+3];if(o===0)return[1,1];let l=3*s[3*e],c=3*s[3*e+1],h=3*s[3*e+2],f=t[c]-t[l],u=t[c+1]-t[l+1],d=t[c+2]-t[l+2],m=t[h]-t[l],_=t[h+1]-t[l+1],p=t[h+2]-t[l+2],g=f*r,M=u*r,A=d*r,b=f*a+m*o,E=u*a+_*o,S=d*a+p*o,x=g*g+M*M+A*A,w=b*b+E*E+S*S,O=g*b+M*E+A*S,P=Math.sqrt(.5*(x+w+Math.sqrt((x-w)**2+4*O*O))),D=M*S-A*E,N=A*b-g*S,V=g*E-M*b;return[P,P>0?Math.sqrt(D*D+N*N+V*V)/P:0]}function fg(n,t,e){let{inverse:i}=n.frames,[s,r,a]=[0,1,2].map(m=>3*n.triangles[3*e+m]),o=i[4*e],l=i[4*e+2],c=i[4*e+3],h=[0,1,2].map(m=>(t[r+m]-t[s+m])*o),f=[0,1,2].map(m=>(t[r+m]-t[s+m])*l+(t[a+m]-t[s+m])*c),u=(m,_)=>m[0]*_[0]+m[1]*_[1]+m[2]*_[2],d=.5*Math.atan2(2*u(h,f),u(h,h)-u(f,f));return[d,d+Math.PI/2].map(m=>[0,1,2].map(_=>h[_]*Math.cos(m)+f[_]*Math.sin(m)))}function dg(n,t,e){return Math.sqrt(6)*e*n.frames.reach[t]}var mu=(n,t)=>{let e=new Float32Array(n.triangleCount);for(let i=0;i<e.length;++i)e[i]=t(i);return e};function x1(n,t,e){let{triangles:i}=n,s=3*i[3*e],r=3*i[3*e+1],a=3*i[3*e+2],o=t[r]-t[s],l=t[r+1]-t[s+1],c=t[r+2]-t[s+2],h=t[a]-t[s],f=t[a+1]-t[s+1],u=t[a+2]-t[s+2],d=o*o+l*l+c*c,m=h*h+f*f+u*u,_=o*h+l*f+c*u,p=Math.sqrt(Math.max(d*m-_*_,0))/2,g=d+m+(d+m-2*_);return g>0?4*Math.sqrt(3)*p/g:0}function pg(n,t){let e=new Float64Array(n.length/4);for(let i=0,s=0;i<e.length;++i,s+=4){let r=3*n[s],a=3*n[s+1],o=3*n[s+2],l=3*n[s+3],c=t[r],h=t[r+1],f=t[r+2],u=t[a]-c,d=t[a+1]-h,m=t[a+2]-f,_=t[o]-c,p=t[o+1]-h,g=t[o+2]-f,M=t[l]-c,A=t[l+1]-h,b=t[l+2]-f,E=d*g-m*p,S=m*_-u*g,x=u*p-d*_,w=A*m-b*d,O=b*u-M*m,P=M*d-A*u,D=S*P-x*O,N=x*w-E*P,V=E*O-S*w,I=Math.sqrt(u*u+d*d+m*m)||1;e[i]=Math.atan2((D*u+N*d+V*m)/I,E*w+S*O+x*P)}return e}function _1(n){if(n._restHinges)return n._restHinges;let{vertices:t,faces:e}=n.hinges,i=new Float64Array(e.length/2);for(let s=0;s<i.length;++s){let r=3*t[4*s],a=3*t[4*s+1],o=[0,1,2].reduce((c,h)=>c+(n.rest[r+h]-n.rest[a+h])**2,0),l=n.frames.areas[e[2*s]]+n.frames.areas[e[2*s+1]];i[s]=l>0?o/(2*l):0}return n._restHinges={weights:i,angles:pg(t,n.rest)},n._restHinges}function y1(n,t){let{vertices:e,faces:i}=n.hinges,s=_1(n),r=pg(e,t),a=new Float32Array(n.triangleCount);for(let o=0;o<r.length;++o){let l=r[o]-s.angles[o];l>Math.PI&&(l-=2*Math.PI),l<-Math.PI&&(l+=2*Math.PI);let c=s.weights[o]*l*l;a[i[2*o]]+=c/2,a[i[2*o+1]]+=c/2}for(let o=0;o<a.length;++o)a[o]=n.frames.areas[o]>0?a[o]/n.frames.areas[o]:NaN;return a}var Wl={stretch:(n,t)=>mu(n,e=>Qs(n,t,e)[0]-1),strain:(n,t)=>mu(n,e=>{let[i,s]=Qs(n,t,e);return Math.max(Math.abs(i-1),Math.abs(s-1))}),quality:(n,t)=>mu(n,e=>x1(n,t,e)),bending:y1};function mg(n,t,e){let i=new Float32Array(n.length/3),s=[0,0,0];for(let r=0;r<i.length;++r)t.place(r,e,s),i[r]=Math.hypot(n[3*r]-s[0],n[3*r+1]-s[1],n[3*r+2]-s[2]);return i}function gg(n,t,e){return n.map((i,s)=>i-e[t.face(s)])}var v1=(n,t)=>n<t?n*67108864+t:t*67108864+n,Xl=class{constructor(t,e){this.rest=t,this.triangles=e,this.vertexCount=t.length/3,this.triangleCount=e.length/3,this.frames=b1(t,e)}get hinges(){return this._hinges??=M1(this.triangles),this._hinges}get around(){return this._around??=S1(this.triangles,this.vertexCount),this._around}ringsFrom(t){let e=new Int32Array(this.vertexCount).fill(-1);e[t]=0;let{first:i,list:s}=this.around;for(let r=[t],a=0;a<r.length;++a)for(let o=i[r[a]];o<i[r[a]+1];++o)for(let l=0;l<3;++l){let c=this.triangles[3*s[o]+l];e[c]<0&&(e[c]=e[r[a]]+1,r.push(c))}return e}equals(t){let e=1e-6*Math.max(...this.rest.map(Math.abs));return t===this||t.rest.length===this.rest.length&&t.triangles.length===this.triangles.length&&this.triangles.every((i,s)=>i===t.triangles[s])&&this.rest.every((i,s)=>Math.abs(i-t.rest[s])<=e)}};function b1(n,t){let e=t.length/3,i=new Float64Array(4*e),s=new Float64Array(e),r=new Float64Array(e);for(let a=0;a<e;++a){let o=3*t[3*a],l=3*t[3*a+1],c=3*t[3*a+2],h=n[l]-n[o],f=n[l+1]-n[o+1],u=n[l+2]-n[o+2],d=n[c]-n[o],m=n[c+1]-n[o+1],_=n[c+2]-n[o+2],p=Math.sqrt(h*h+f*f+u*u),g=(h*d+f*m+u*_)/p,M=d-g*h/p,A=m-g*f/p,b=_-g*u/p,E=Math.sqrt(M*M+A*A+b*b);if(s[a]=p*E/2,!(E>1e-9*p))continue;i[4*a]=1/p,i[4*a+2]=-g/(p*E),i[4*a+3]=1/E;let S=1/p**2+(g/(p*E))**2+1/E**2;r[a]=Math.sqrt((S+Math.sqrt(Math.max(S**2-4/(p*E)**2,0)))/2)}return{inverse:i,areas:s,reach:r}}function M1(n){let t=new Map,e=[],i=[];for(let s=0;s<n.length/3;++s)for(let r=0;r<3;++r){let a=n[3*s+r],o=n[3*s+(r+1)%3],l=n[3*s+(r+2)%3],c=v1(a,o),h=t.get(c);h===void 0?t.set(c,[a,o,l,s]):(e.push(h[0],h[1],h[2],l),i.push(h[3],s))}return{vertices:Uint32Array.from(e),faces:Uint32Array.from(i)}}function S1(n,t){let e=new Uint32Array(t+1);for(let r of n)++e[r+1];for(let r=0;r<t;++r)e[r+1]+=e[r];let i=e.slice(),s=new Uint32Array(n.length);return n.forEach((r,a)=>{s[i[r]++]=Math.floor(a/3)}),{first:e,list:s}}var ql=class{constructor(t,e){if(this.same=t.equals(e),this.onto=e,this.same)return;let i=new gu(e),s=t.vertexCount;this.vertexTriangle=new Uint32Array(s),this.shares=new Float32Array(3*s);let r=0;for(let a=0;a<s;++a){let o=i.nearest(t.rest.subarray(3*a,3*a+3));this.vertexTriangle[a]=o.triangle,this.shares.set(o.shares,3*a),r=Math.max(r,o.distance)}this.faceTriangle=Uint32Array.from({length:t.triangleCount},(a,o)=>{let l=[0,1,2].map(c=>[0,1,2].reduce((h,f)=>h+t.rest[3*t.triangles[3*o+f]+c]/3,0));return i.nearest(l).triangle}),this.farthest=r}vertex(t){if(this.same)return t;let e=this.shares.subarray(3*t,3*t+3);return this.onto.triangles[3*this.vertexTriangle[t]+e.indexOf(Math.max(...e))]}face(t){return this.same?t:this.faceTriangle[t]}place(t,e,i){if(this.same){for(let r=0;r<3;++r)i[r]=e[3*t+r];return}let s=3*this.vertexTriangle[t];for(let r=0;r<3;++r)i[r]=[0,1,2].reduce((a,o)=>a+this.shares[3*t+o]*e[3*this.onto.triangles[s+o]+r],0)}},gu=class{constructor(t){this.mesh=t,this.low=[1/0,1/0,1/0];let e=[-1/0,-1/0,-1/0];t.rest.forEach((s,r)=>{this.low[r%3]=Math.min(this.low[r%3],s),e[r%3]=Math.max(e[r%3],s)});let i=Math.hypot(...e.map((s,r)=>s-this.low[r]))||1;this.cell=i/Math.max(4,Math.sqrt(t.triangleCount)),this.cells=new Map;for(let s=0;s<t.triangleCount;++s){let r=[0,1,2].map(l=>this.#n(this.#t(s,l))),a=[0,1,2].map(l=>Math.min(...r.map(c=>c[l]))),o=[0,1,2].map(l=>Math.max(...r.map(c=>c[l])));for(let l=a[0];l<=o[0];++l)for(let c=a[1];c<=o[1];++c)for(let h=a[2];h<=o[2];++h){let f=`${l},${c},${h}`;this.cells.has(f)||this.cells.set(f,[]),this.cells.get(f).push(s)}}}#t(t,e){let i=3*this.mesh.triangles[3*t+e];return this.mesh.rest.subarray(i,i+3)}#n(t){return[0,1,2].map(e=>Math.floor((t[e]-this.low[e])/this.cell))}nearest(t){let e=this.#n(t),i=null;for(let s=0;s<64&&!(i&&i.distance<=(s-1)*this.cell);++s)for(let r=-s;r<=s;++r)for(let a=-s;a<=s;++a)for(let o=-s;o<=s;++o)if(Math.max(Math.abs(r),Math.abs(a),Math.abs(o))===s)for(let l of this.cells.get(`${e[0]+r},${e[1]+a},${e[2]+o}`)??[]){let c=w1(t,this.#t(l,0),this.#t(l,1),this.#t(l,2));(!i||c.distance<i.distance)&&(i={triangle:l,...c})}return i??{triangle:0,shares:[1,0,0],distance:1/0}}};function w1(n,t,e,i){let s=(S,x)=>[S[0]-x[0],S[1]-x[1],S[2]-x[2]],r=(S,x)=>S[0]*x[0]+S[1]*x[1]+S[2]*x[2],a=s(e,t),o=s(i,t),l=s(n,t),c=s(n,e),h=s(n,i),f=r(a,l),u=r(o,l),d=r(a,c),m=r(o,c),_=r(a,h),p=r(o,h),g=d*p-_*m,M=_*u-f*p,A=f*m-d*u,b;if(f<=0&&u<=0)b=[1,0,0];else if(d>=0&&m<=d)b=[0,1,0];else if(p>=0&&_<=p)b=[0,0,1];else if(A<=0&&f>=0&&d<=0)b=[1-f/(f-d),f/(f-d),0];else if(M<=0&&u>=0&&p<=0)b=[1-u/(u-p),0,u/(u-p)];else if(g<=0&&m>=d&&_>=p){let S=(m-d)/(m-d+_-p);b=[0,1-S,S]}else{let S=g+M+A||1;b=[g/S,M/S,A/S]}let E=[0,1,2].map(S=>b[0]*t[S]+b[1]*e[S]+b[2]*i[S]);return{shares:b,distance:Math.hypot(...s(n,E))}}var A1=.2,$l=class{constructor(t){this.quantities=t,this.maps=new Map,this.ranges=new Map}map(t,e){let i=`${t.run.id} ${e.run.id}`;if(!this.maps.has(i)){let s=new ql(t.mesh,e.mesh);this.maps.set(i,s.same||s.farthest<=A1*Math.max(t.size,e.size)?s:null)}return this.maps.get(i)}choices(t){return this.quantities.filter(({key:e})=>t||e!=="distance").map(e=>t?xg(e):e)}quantity(t,e){let i=this.quantities.find(s=>s.key===t)??this.quantities[0];return e?xg(i):i}values(t,e,i,s=e.cloth.positions,r=i?.cloth.positions){if(t==="none"||i&&i===e)return null;if(!i)return{values:Wl[t](e.mesh,s),smooth:!1};let a=this.map(e,i);return a?t==="distance"?{values:mg(s,a,r),smooth:!0}:{values:gg(Wl[t](e.mesh,s),a,Wl[t](i.mesh,r)),smooth:!1}:null}range(t,e,i){let s=`${t} ${i?.run.id??""}`;if(!this.ranges.has(s)){let r=this.quantity(t,i);this.ranges.set(s,r.range??this.#t(r,e,i))}return this.ranges.get(s)}setRange(t,e,i){this.ranges.set(`${t} ${e?.run.id??""}`,i)}#t(t,e,i){let s=[];for(let o of e)for(let l of[0,.2,.45,.7,1]){let c=o.frames.times[0]+l*(o.frames.times.at(-1)-o.frames.times[0]),h=this.values(t.key,o,i,o.frames.positions(o.frames.frameAt(c)),i?.frames.positions(i.frames.frameAt(c)));if(!h)continue;let f=Math.max(1,Math.floor(h.values.length/2e3));for(let u=0;u<h.values.length;u+=f)Number.isFinite(h.values[u])&&s.push(t.signed?Math.abs(h.values[u]):h.values[u])}s.sort((o,l)=>o-l);let a=T1((o=>s.length?s[Math.min(s.length-1,Math.floor(o*s.length))]:0)(.995))||1;return t.signed?[-a,a]:t.scale==="log"?[a/1e4,a]:[0,a]}};function xg(n){return["none","distance"].includes(n.key)?n:{...n,name:`Difference in ${n.name.toLowerCase()}`,symbol:`\u0394 ${n.symbol}`,map:"difference",scale:"linear",range:null,signed:!0,meaning:`This run minus the other run. ${n.meaning}`}}function T1(n){if(!(n>0))return 0;let t=10**Math.floor(Math.log10(n));return t*[1,2,5,10].find(e=>e*t>=n*(1-1e-9))}var Yl=class{constructor(t,e){this.colours=t,this.name=C("span",{class:"player-bar-name"}),this.canvas=C("canvas",{width:256,height:1,class:"player-bar-colours","aria-hidden":"true"});let i=s=>C("input",{type:"text",inputmode:"decimal","aria-label":s,size:6,onchange:()=>this.#t(e),onkeydown:r=>r.key==="Enter"&&this.#t(e)});this.low=i("Smallest value of the colour bar"),this.high=i("Largest value of the colour bar"),this.ticks=C("span",{class:"player-bar-ticks","aria-hidden":"true"}),this.element=C("div",{class:"player-colours"},this.name,this.low,C("span",{class:"player-bar-strip"},this.canvas,this.ticks),this.high)}show(t,e){let{map:i}=t;if(this.quantity=t,this.range=e,this.element.hidden=!i,!i)return;let s=t.unit&&t.unit!=="1"?` (${t.unit})`:"";this.name.textContent=`${t.symbol||t.name}${s}`,this.name.title=t.meaning,_g(this.low,e[0]),_g(this.high,e[1]);let r=this.canvas.getContext("2d");for(let a=0;a<256;++a)r.fillStyle=`#${this.colours.maps[i].substr(6*a,6)}`,r.fillRect(a,0,1,1);this.ticks.replaceChildren(...xu(t,e).map(({share:a,text:o})=>{let l=C("span",{},o);return l.style.left=`${100*a}%`,l}))}#t(t){let[e,i]=[this.low,this.high].map(r=>Number(r.value.replace("\u2212","-").replace(",","."))),s=Number.isFinite(e)&&Number.isFinite(i)&&e<i&&(this.quantity.scale!=="log"||e>0);this.element.classList.toggle("player-wrong",!s),this.element.title=s?"":this.quantity.scale==="log"?"Two positive numbers are needed, the smaller one on the left.":"The smaller number belongs on the left.",s&&t(e,i)}};function _g(n,t){document.activeElement!==n&&(n.value=E1(t))}function E1(n){return String(Number(n.toPrecision(3)))}function xu(n,[t,e]){let i=[];if(n.scale==="log"){let s=Math.ceil(Math.log10(t)+1e-9),r=Math.floor(Math.log10(e)-1e-9),a=Math.max(1,Math.ceil((r-s+1)/4));for(let o=s;o<=r;o+=a)i.push({share:Math.log(10**o/t)/Math.log(e/t),text:Vt(10**o,1)})}else{let s=10**Math.floor(Math.log10((e-t)/2)),r=(e-t)/s>6?5*s:(e-t)/s>3?2*s:s;for(let a=Math.ceil(t/r+1e-9);a*r<e-1e-9*r;++a)i.push({share:(a*r-t)/(e-t),text:Vt(Number((a*r).toPrecision(6)),2).replace(/(\.\d*?)0+$/,"$1").replace(/\.$/,"")})}return i.filter(({share:s})=>s>.08&&s<.92)}var yg={play:"M7 4.5v15l12.5-7.5z",pause:"M7 5h3.6v14H7zM13.4 5H17v14h-3.6z",back:"M17 5v14l-9-7zM5 5h2.2v14H5z",forward:"M7 5v14l9-7zM16.8 5H19v14h-2.2z",loop:"M17 3l4 4-4 4V8H8a3 3 0 0 0-3 3v1H3v-1a5 5 0 0 1 5-5h9zM7 21l-4-4 4-4v3h9a3 3 0 0 0 3-3v-1h2v1a5 5 0 0 1-5 5H7z",link:"M10.6 13.4a4 4 0 0 0 5.7 0l3.5-3.5a4 4 0 0 0-5.7-5.7l-1.6 1.6 1.4 1.4 1.6-1.6a2 2 0 0 1 2.9 2.9l-3.5 3.5a2 2 0 0 1-2.9 0zM13.4 10.6a4 4 0 0 0-5.7 0l-3.5 3.5a4 4 0 0 0 5.7 5.7l1.6-1.6-1.4-1.4-1.6 1.6a2 2 0 0 1-2.9-2.9l3.5-3.5a2 2 0 0 1 2.9 0z",reset:"M12 5V1.8L7.3 6.2 12 10.6V7a5.5 5.5 0 1 1-5.5 5.5h-2A7.5 7.5 0 1 0 12 5z",full:"M4 4h6v2H6v4H4zM14 4h6v6h-2V6h-4zM4 14h2v4h4v2H4zM18 14h2v6h-6v-2h4z",camera:"M9 4h6l1.6 2.4H20a1.6 1.6 0 0 1 1.6 1.6v10A1.6 1.6 0 0 1 20 19.6H4A1.6 1.6 0 0 1 2.4 18V8A1.6 1.6 0 0 1 4 6.4h3.4zM12 9a4 4 0 1 0 0 8 4 4 0 0 0 0-8z",film:"M3 5h18v14H3zM5 7v2h2V7zm0 4v2h2v-2zm0 4v2h2v-2zm12-8v2h2V7zm0 4v2h2v-2zm0 4v2h2v-2zM9 7v10h6V7z",grid:"M3 20L12 3l9 17zm4.2-2.4h4V10zm9.6 0L12.8 10v7.6z"};function vg(n){return Tt("svg",{viewBox:"0 0 24 24",width:18,height:18,"aria-hidden":"true",focusable:"false"},Tt("path",{d:yg[n],fill:"currentColor","fill-rule":"evenodd"}))}function bg(n,t){n.querySelector("path").setAttribute("d",yg[t])}var Mg=[["Time",[[" ","k"],"Space","play, pause",n=>n.toggle()],[["ArrowLeft"],"\u2190","one frame back",n=>n.step(-1)],[["ArrowRight"],"\u2192","one frame forward",n=>n.step(1)],[["PageUp"],"Page up","ten frames back",n=>n.step(-10)],[["PageDown"],"Page down","ten frames forward",n=>n.step(10)],[["Home"],"Home","first frame",n=>n.seek(n.first)],[["End"],"End","last frame",n=>n.seek(n.last)],[["["],"[","slower",n=>n.changeSpeed(-1)],[["]"],"]","faster",n=>n.changeSpeed(1)],[["l"],"L","loop",n=>n.setLoop(!n.loop)]],["Camera",[["Shift+ArrowLeft"],"Shift \u2190","turn left",n=>n.move(t=>t.turn(-8,0))],[["Shift+ArrowRight"],"Shift \u2192","turn right",n=>n.move(t=>t.turn(8,0))],[["Shift+ArrowUp"],"Shift \u2191","look from above",n=>n.move(t=>t.turn(0,6))],[["Shift+ArrowDown"],"Shift \u2193","look from below",n=>n.move(t=>t.turn(0,-6))],[["Ctrl+ArrowLeft"],"Ctrl \u2190 \u2192 \u2191 \u2193","move the picture",n=>n.move(t=>t.pan(-.06,0))],[["Ctrl+ArrowRight"],"","",n=>n.move(t=>t.pan(.06,0))],[["Ctrl+ArrowUp"],"","",n=>n.move(t=>t.pan(0,.06))],[["Ctrl+ArrowDown"],"","",n=>n.move(t=>t.pan(0,-.06))],[["+","="],"+","nearer",n=>n.move(t=>t.zoom(.87))],[["-","_"],"\u2212","farther",n=>n.move(t=>t.zoom(1.15))],[["r"],"R","first view",n=>n.resetCameras()],[["c"],"C","cameras locked together, or one for each run",n=>n.setLinked(!n.linked)]],["Colours",[["q"],"Q","next quantity",n=>n.nextQuantity(1)],[["Q"],"Shift Q","quantity before",n=>n.nextQuantity(-1)],[["d"],"D","compare with the next run",n=>n.nextReference()],[["g"],"G","lines of the mesh",n=>n.setLines(!n.lines)]],["Values",[["v"],"V","choose a vertex by its number",n=>n.askFor("vertex")],[["t"],"T","choose a triangle by its number",n=>n.askFor("triangle")],[["Escape"],"Esc","close the values",n=>n.clearPick()]],["Page",[["f"],"F","full screen",n=>n.fullScreen()],[["s"],"S","save this picture (PNG)",n=>n.saveStill()],[["a"],"A","save the motion (WebM or animated PNG)",n=>n.saveAnimation()],[["?"],"?","this list",n=>n.showKeys()]]];function Sg(n,t){if(t.altKey||t.metaKey||t.defaultPrevented||t.target.closest("input:not([type=range]):not([type=checkbox]), textarea, select")&&t.key!=="Escape"||t.target.closest("dialog.player-keys")||t.key.startsWith("Arrow")&&t.target.closest(".player-panel .scroll")||t.key===" "&&t.target.closest("button, summary, a, [type=checkbox]"))return!1;let i=t.key.length===1?t.key:null,s=t.shiftKey&&!i?"Shift+":"",r=`${t.ctrlKey?"Ctrl+":""}${s}${t.key}`;for(let[,...a]of Mg)for(let[o,,,l]of a)if(o.includes(r))return t.key==="Escape"&&!n.hasPick()?!1:(t.preventDefault(),l(n),!0);return!1}function wg(){let n=C("button",{type:"button",class:"player-close","aria-label":"Close",onclick:()=>t.close()},"\xD7"),t=C("dialog",{class:"player-keys","aria-label":"Keys of the player"},n,C("h3",{},"Keys"),C("p",{},"The keys act while the player has the focus. Drag to turn the cloth; drag with the right button or two fingers to move the picture. Pinch to zoom, or click a view and turn the wheel. Click or tap the cloth to see values."),C("div",{class:"player-keys-list"},...Mg.map(([e,...i])=>C("table",{},C("caption",{},e),C("tbody",{},...i.filter(([,s])=>s).map(([,s,r])=>C("tr",{},C("td",{},C("kbd",{},s)),C("td",{},r))))))));return t.addEventListener("click",e=>e.target===t&&t.close()),t}function Zl(n,t){return t<620?Math.min(n,2):n<=3?n:n===4?t>1e3?4:2:n<=6?3:4}function Ag(n,t,e){let i=Zl(n,t),s=Math.ceil(n/i),r=t/i,a=n===1?Math.min(.62*t,560):Math.min(Math.max(.95*r,190),460);return Math.round(Math.max(Math.min(s*a,Math.max(.78*e,s*170)),220))}var Jl=class{constructor(t,e){let i=s=>C("input",{type:"number",min:0,step:1,"aria-label":`Number of a ${s}`,oninput:r=>{this.typing=r.target},onblur:()=>{this.typing=null},onchange:r=>{this.typing=null,r.target.value!==""&&!this.element.hidden&&t(s,Number(r.target.value))}});this.typing=null,this.vertex=i("vertex"),this.triangle=i("triangle"),this.table=C("table",{}),this.springs=C("p",{class:"player-springs"}),this.element=C("section",{class:"player-panel","aria-label":"Picked values",hidden:!0},C("div",{class:"player-panel-head"},C("label",{},"Vertex ",this.vertex),C("label",{},"Triangle ",this.triangle),C("button",{type:"button",onclick:e,title:"Close (Esc)","aria-label":"Close the values"},"\xD7")),C("div",{class:"scroll",tabindex:0,role:"region","aria-label":"Picked values"},this.table),this.springs)}show(t,e=[]){let i=t.filter(o=>o.picked.vertex!==null);if(this.element.hidden=!i.length,!i.length)return;let[s]=i;this.typing!==this.vertex&&(this.vertex.value=s.picked.vertex),this.typing!==this.triangle&&(this.triangle.value=s.picked.triangle??"");let r=(o,l,c="")=>C("tr",{},C("th",{scope:"row",title:c},o),...i.map(h=>C("td",{},l(h)))),a=o=>C("tr",{class:"player-group"},C("th",{scope:"rowgroup",colspan:i.length+1},o));this.table.replaceChildren(C("thead",{},C("tr",{},C("td",{}),...i.map(o=>C("th",{scope:"col"},o.run.label)))),C("tbody",{},r("frame",o=>`${o.frames.head.chosen[o.frame]} (${Vt(o.time,4)} s)`),a("Vertex"),r("number",o=>String(o.picked.vertex)),r("position (m)",C1,"x, y, z; the page rounds positions to multiples of a step"),r("rounded by at most (m)",o=>`\xB1 ${Vt(o.frames.head.step/2,2)}`),r("from its rest place (m)",o=>Vt(R1(o),4)),r("speed (m/s)",o=>Vt(I1(o),3),"since the recorded frame before"),...e.filter(({of:o})=>o==="vertex").map(({name:o,text:l})=>r(o,l)),a("Triangle"),r("number",o=>o.picked.triangle===null?"\u2013":String(o.picked.triangle)),r("vertices",o=>o.picked.triangle===null?"\u2013":[...o.mesh.triangles.subarray(3*o.picked.triangle,3*o.picked.triangle+3)].join(", ")),r("stretch \u03C3\u2081",o=>Tg(o,0),"larger principal stretch; \xB1 error by rounding"),r("stretch \u03C3\u2082",o=>Tg(o,1),"smaller principal stretch"),...e.filter(({of:o})=>o==="triangle").map(({name:o,text:l})=>r(o,l)))),this.#t(i)}#t(t){this.springs.replaceChildren();let e=new Map;for(let i of t){let{missing:s}=i.frames.head.springs,r=i.picked.springs.length?i.picked.springs.map(({ring:o,count:l})=>({ring:o,text:`ring ${o}: ${l}`})):s??(i.picked.read?"No spring acts on this vertex.":"Its springs are being read \u2026"),a=typeof r=="string"?r:i.run.id;e.set(a,{label:e.has(a)?`${e.get(a).label}; ${i.run.label}`:i.run.label,text:r,rings:i.picked.rings})}for(let{label:i,text:s,rings:r}of e.values()){let a=C("span",{},C("b",{},t.length>1?`Springs of ${i} `:"Springs "));if(typeof s=="string")a.append(s);else for(let{ring:o,text:l}of s){let c=C("i",{class:"player-ring"});c.style.background=r[(o-1+r.length)%r.length],a.append(C("span",{class:"player-ring-text"},c,l)," ")}this.springs.append(a)}}},ia=(n,t)=>t.subarray(3*n.picked.vertex,3*n.picked.vertex+3);function C1(n){let t=Math.max(0,Math.ceil(-Math.log10(n.frames.head.step)));return[...ia(n,n.cloth.positions)].map(e=>Ln(e.toFixed(t))).join(", ")}function R1(n){let t=ia(n,n.mesh.rest);return Math.hypot(...ia(n,n.cloth.positions).map((e,i)=>e-t[i]))}function I1(n){if(n.frame===0)return NaN;let t=ia(n,n.frames.positions(n.frame-1));return Math.hypot(...ia(n,n.cloth.positions).map((i,s)=>i-t[s]))/(n.time-n.frames.times[n.frame-1])}function Tg(n,t){let e=n.picked.triangle;if(e===null)return"\u2013";let i=dg(n.mesh,e,n.frames.head.step),s=Math.min(6,Math.max(2,Math.ceil(-Math.log10(i))));return`${Qs(n.mesh,n.cloth.positions,e)[t].toFixed(s)} \xB1 ${Vt(i,1)}`}var sa=[[.1,"0.1 \xD7"],[.25,"\xBC \xD7"],[.5,"\xBD \xD7"],[1,"1 \xD7"],[2,"2 \xD7"],[4,"4 \xD7"]],Kl=class{constructor(t){this.player=t;let e=(i,s,r,a,o={})=>C("button",{type:"button",class:"player-button","aria-label":s,title:r?`${s} (${r})`:s,"aria-keyshortcuts":r,onclick:a,...o},vg(i));this.quantity=C("select",{"aria-label":"Colour",onchange:i=>t.setQuantity(i.target.value)}),this.reference=C("select",{"aria-label":"Compare with",onchange:i=>t.setReference(i.target.value||null)}),this.bar=new Yl(Xt().colours,(i,s)=>t.setRange(i,s)),this.runs=C("details",{class:"player-runs",hidden:""}),this.compareLabel=C("label",{},C("span",{},"Compare with"),this.reference),this.top=C("div",{class:"player-top"},C("label",{},C("span",{},"Colour"),this.quantity),this.compareLabel,this.bar.element),this.canvas=C("canvas",{"aria-hidden":"true"}),this.grid=C("div",{class:"player-views"}),this.message=C("p",{class:"player-message",role:"status"}),this.stage=C("div",{class:"player-stage"},this.canvas,this.grid),this.playButton=e("play","Play","Space",()=>t.toggle()),this.loopButton=e("loop","Loop","L",()=>t.setLoop(!t.loop),{"aria-pressed":"false"}),this.linkButton=e("link","Cameras locked together","C",()=>t.setLinked(!t.linked),{"aria-pressed":"true"}),this.linesButton=e("grid","Lines of the mesh","G",()=>t.setLines(!t.lines),{"aria-pressed":"true"}),this.fullButton=e("full","Full screen","F",()=>t.fullScreen()),this.filmButton=e("film","Save the motion","A",()=>t.saveAnimation()),this.slider=C("input",{type:"range",class:"player-slider","aria-label":"Time",step:"any",oninput:i=>{t.stop(),t.seek(Number(i.target.value))}}),this.clock=C("span",{class:"player-clock"}),this.speed=C("select",{"aria-label":"Speed",title:"Speed ([ slower, ] faster)",onchange:i=>t.setSpeed(Number(i.target.value))},...sa.map(([i,s])=>C("option",{value:i},s))),this.times=C("div",{class:"player-times"},e("back","One frame back","\u2190",()=>t.step(-1),{"aria-keyshortcuts":"ArrowLeft"}),this.playButton,e("forward","One frame on","\u2192",()=>t.step(1),{"aria-keyshortcuts":"ArrowRight"}),this.slider,this.clock,this.speed,this.loopButton),this.tools=C("div",{class:"player-tools"},this.linkButton,e("reset","First view","R",()=>t.resetCameras()),this.linesButton,e("camera","Save this picture","S",()=>t.saveStill()),this.filmButton,this.fullButton,C("button",{type:"button",class:"player-button","aria-label":"Keys",title:"Keys (?)","aria-keyshortcuts":"?",onclick:()=>this.showKeys()},"?")),this.notes=C("ul",{class:"player-notes"}),this.panel=new Jl((i,s)=>t.pickNumber(i,s),()=>t.clearPick()),this.keys=wg(),this.cells=[],this.parts=[this.top,this.stage,C("div",{class:"player-bottom"},this.times,this.tools),this.runs,this.message,this.panel.element,this.notes,this.keys]}showCells(t){this.cells=t.map(i=>{let s=C("span",{class:"player-name"},i.label),r=i.status&&!["complete","implausible"].includes(i.status)?i.status:"";return C("div",{class:"player-view",tabindex:0,role:"img","aria-label":`${i.label}: cloth. Click or tap a point for its values.`},s,C("span",{class:"player-state"},r),C("span",{class:"player-note"}))}),this.grid.replaceChildren(...this.cells);let e=[...new Set(t.flatMap(i=>(i.frames?.notes??[]).map(s=>t.length>1?`${i.label}: ${s}`:s)))];this.notes.replaceChildren(...e.map(i=>C("li",{},i))),this.layOut(Math.min(t.length,4),Math.ceil(t.length/4),this.stage.clientHeight||360)}layOut(t,e,i){this.grid.style.gridTemplateColumns=`repeat(${t}, minmax(0, 1fr))`,this.grid.style.gridTemplateRows=`repeat(${e}, minmax(0, 1fr))`,this.stage.style.height=i===null?"":`${i}px`,this.cells.forEach((s,r)=>{s.classList.toggle("player-left",r%t===0),s.classList.toggle("player-upper",r<t)})}problem(t,e){t.classList.add("player-empty"),t.setAttribute("aria-label",`${t.querySelector(".player-name").textContent}: ${e}`);let[i,s]=e.split(/(?=\.\/bendlab )/);t.append(C("p",{},i,s?C("code",{},s):null))}note(t,e){let i=this.player.cells.find(s=>s.view===t).element;i.querySelector(".player-note").textContent=e}showRuns(t){let{player:e}=this;if(this.runs.hidden=e.ids.length<2,this.runs.hidden)return;let i=e.ids.map(r=>C("label",{},C("input",{type:"checkbox",value:r,checked:t.some(a=>a.id===r),onchange:a=>this.#t(a.target)}),qa(r).label)),s=this.runs.open;this.runs.replaceChildren(C("summary",{},`${t.length} of ${e.ids.length} runs shown`),C("div",{class:"player-choices"},...i)),this.runs.open=s}#t(t){let e=[...this.runs.querySelectorAll("input:checked")].map(s=>s.value);if(!e.length||e.length>8){t.checked=!t.checked,this.say(`Between 1 and ${8} runs can be shown.`);return}let i=t.value;this.player.show(e).then(()=>this.runs.querySelector(`input[value="${CSS.escape(i)}"]`)?.focus())}ready(){let{player:t}=this;for(let e of[this.top,this.times,this.tools])e.hidden=!1;this.slider.min=t.first,this.slider.max=t.last,this.compareLabel.hidden=t.views.length<2,this.reference.replaceChildren(C("option",{value:""},"nothing"),...t.views.map(e=>C("option",{value:e.run.id},e.run.label))),this.linkButton.hidden=t.views.length<2,this.update(),t.referenceId&&t.setReference(t.referenceId)}disable(t=""){for(let e of[this.top,this.times,this.tools])e.hidden=!0;this.stage.style.height="auto",this.stage.classList.add("player-nothing"),this.say(t)}update(){let{player:t}=this,e=(r,a)=>r.setAttribute("aria-pressed",String(!!a));bg(this.playButton,t.playing?"pause":"play");let i=(r,a)=>{r.setAttribute("aria-label",a),r.title=`${a} (${r.getAttribute("aria-keyshortcuts")})`};i(this.playButton,t.playing?"Pause":"Play"),e(this.loopButton,t.loop),e(this.linkButton,t.linked),e(this.linesButton,t.lines),i(this.filmButton,t.recorder?.recording?"End the recording":"Save the motion"),this.filmButton.classList.toggle("player-recording",!!t.recorder?.recording),this.speed.value=String(t.speed);let s=t.compare.choices(t.reference);this.quantity.replaceChildren(...s.map(({key:r,name:a,meaning:o})=>C("option",{value:r,title:o},a))),this.quantity.value=t.key,this.reference.value=t.referenceId??""}tell(t,e){let{player:i}=this,s=i.last-i.first<.2?4:2;this.slider.value=i.time,this.slider.setAttribute("aria-valuetext",`${i.time.toFixed(s)} s`),this.clock.textContent=`${i.time.toFixed(s)} / ${i.last.toFixed(s)} s`;let r=JSON.stringify([t.name,e]);this.legend!==r&&this.bar.show(t,e),this.legend=r;for(let{view:a,element:o}of i.cells){let l=i.time>a.frames.times.at(-1)+1e-9,c=o.querySelector(".player-state"),h=[a.run.status&&!["complete","implausible"].includes(a.run.status)?a.run.status:"",l?`ends at ${a.frames.times.at(-1).toFixed(s)} s`:""].filter(Boolean).join(", ");c.textContent!==h&&(c.textContent=h)}}say(t){this.message.textContent=t,clearTimeout(this.saying),t&&(this.saying=setTimeout(()=>{this.message.textContent=""},6e3))}showKeys(){this.keys.showModal()}};var jl=30,Ql=class{constructor(){this.home=null,Object.assign(this,{azimuth:-62,elevation:18,distance:3,target:[0,0,0],moved:!1})}copy(t){Object.assign(this,{azimuth:t.azimuth,elevation:t.elevation,distance:t.distance,target:[...t.target],moved:t.moved,home:t.home})}axes(){let t=this.azimuth*Math.PI/180,e=this.elevation*Math.PI/180,i=[Math.cos(e)*Math.cos(t),Math.cos(e)*Math.sin(t),Math.sin(e)],s=[-Math.sin(t),Math.cos(t),0],r=[-Math.sin(e)*Math.cos(t),-Math.sin(e)*Math.sin(t),Math.cos(e)];return[s,r,i]}turn(t,e){this.azimuth-=t,this.elevation=Math.min(89,Math.max(-89,this.elevation+e)),this.moved=!0}zoom(t){this.distance=Math.min(60,Math.max(.02,this.distance*t)),this.moved=!0}pan(t,e){let[i,s]=this.axes(),r=2*this.distance*Math.tan(jl/360*Math.PI);this.target=this.target.map((a,o)=>a-r*(t*i[o]+e*s[o])),this.moved=!0}frame(t,e){if(!this.moved||!this.home){let[i,s,r]=this.axes(),a=Math.tan(jl/360*Math.PI),o=[1/0,1/0,1/0],l=[-1/0,-1/0,-1/0],c=(u,d)=>t[u]*d[0]+t[u+1]*d[1]+t[u+2]*d[2];for(let u=0;u<t.length;u+=3)[i,s,r].forEach((d,m)=>{o[m]=Math.min(o[m],c(u,d)),l[m]=Math.max(l[m],c(u,d))});let h=o.map((u,d)=>(u+l[d])/2),f=.05;for(let u=0;u<t.length;u+=3){let d=c(u,r)-h[2];f=Math.max(f,d+1.1*Math.abs(c(u,i)-h[0])/(a*e),d+1.14*Math.abs(c(u,s)-h[1])/a)}this.target=[0,1,2].map(u=>h[0]*i[u]+h[1]*s[u]+h[2]*r[u]),this.distance=f,this.moved=!1,this.home={azimuth:this.azimuth,elevation:this.elevation}}}reset(){this.home&&Object.assign(this,this.home),this.moved=!1}place(t,e,i,s){let r=this.axes()[2],a=e.map((o,l)=>o+i*this.target[l]);t.position.set(...a.map((o,l)=>o+i*this.distance*r[l])),t.up.set(0,0,1),t.lookAt(new F(...a)),t.fov=jl,t.aspect=s,t.near=i*Math.max(.01,this.distance-3),t.far=i*(this.distance+5),t.updateProjectionMatrix(),t.updateMatrixWorld()}},Eg=()=>new Xe(jl,1,.01,10);function Cg(n,t,e){let i=new Map,s=0;n.addEventListener("pointerdown",a=>{n.setPointerCapture(a.pointerId),i.set(a.pointerId,{x:a.clientX,y:a.clientY}),i.size===1&&(s=0)}),n.addEventListener("pointermove",a=>{let o=i.get(a.pointerId);if(!o)return;let l=a.clientX-o.x,c=a.clientY-o.y;s+=Math.abs(l)+Math.abs(c);let h=n.clientHeight||1,[f]=[...i].filter(([u])=>u!==a.pointerId).map(([,u])=>u);if(f){let u=m=>Math.hypot(m.x-f.x,m.y-f.y)||1,d=u(o)/u({x:a.clientX,y:a.clientY});t(m=>{m.zoom(d),m.pan(l/2/h,-c/2/h)})}else if(s>3){let u=a.buttons===2||a.buttons===4||a.ctrlKey||a.metaKey;t(d=>u?d.pan(l/h,-c/h):d.turn(l*.4,c*.4))}i.set(a.pointerId,{x:a.clientX,y:a.clientY})});let r=a=>{if(i.delete(a.pointerId)&&s<=3&&a.type==="pointerup"&&a.button===0){let o=n.getBoundingClientRect();e(a.clientX-o.left,a.clientY-o.top)}};n.addEventListener("pointerup",r),n.addEventListener("pointercancel",r),n.addEventListener("contextmenu",a=>a.preventDefault()),n.addEventListener("wheel",a=>{!a.ctrlKey&&!a.metaKey&&!n.contains(document.activeElement)||(a.preventDefault(),t(o=>o.zoom(Math.exp(a.deltaY*.0012))))},{passive:!1})}ft.line={worldUnits:{value:1},linewidth:{value:1},resolution:{value:new $t},dashOffset:{value:0},dashScale:{value:1},dashSize:{value:1},gapSize:{value:1}};Ze.line={uniforms:jr.merge([ft.common,ft.fog,ft.line]),vertexShader:`
		#include <common>
		#include <color_pars_vertex>
		#include <fog_pars_vertex>
		#include <logdepthbuf_pars_vertex>
		#include <clipping_planes_pars_vertex>

		uniform float linewidth;
		uniform vec2 resolution;

		attribute vec3 instanceStart;
		attribute vec3 instanceEnd;

		attribute vec3 instanceColorStart;
		attribute vec3 instanceColorEnd;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#ifdef USE_DASH

			uniform float dashScale;
			attribute float instanceDistanceStart;
			attribute float instanceDistanceEnd;
			varying float vLineDistance;

		#endif

		float trimSegmentAlpha( const in vec4 start, const in vec4 end ) {

			// compute the interpolation factor needed to trim the segment so it terminates
			// between the camera plane and the near plane

			// conservative estimate of the near plane
			float a = projectionMatrix[ 2 ][ 2 ]; // 3nd entry in 3th column
			float b = projectionMatrix[ 3 ][ 2 ]; // 3nd entry in 4th column

			// we need different nearEstimate formula for reversed and default depth buffer
			// a is positive with a reversed depth buffer so it can be used for controlling the code flow
			float nearEstimate = ( a > 0.0 ) ? ( - b / ( a + 1.0 ) ) : ( - 0.5 * b / a );

			return ( nearEstimate - start.z ) / ( end.z - start.z );

		}

		void main() {

			#ifdef USE_COLOR

				vColor.xyz = ( position.y < 0.5 ) ? instanceColorStart : instanceColorEnd;

			#endif

			float aspect = resolution.x / resolution.y;

			// camera space
			vec4 start = modelViewMatrix * vec4( instanceStart, 1.0 );
			vec4 end = modelViewMatrix * vec4( instanceEnd, 1.0 );

			#ifdef USE_DASH

				float lineDistanceStart = dashScale * instanceDistanceStart;
				float lineDistanceEnd = dashScale * instanceDistanceEnd;

			#endif

			#ifdef WORLD_UNITS

				worldStart = start.xyz;
				worldEnd = end.xyz;

			#else

				vUv = uv;

			#endif

			// special case for perspective projection, and segments that terminate either in, or behind, the camera plane
			// clearly the gpu firmware has a way of addressing this issue when projecting into ndc space
			// but we need to perform ndc-space calculations in the shader, so we must address this issue directly
			// perhaps there is a more elegant solution -- WestLangley

			bool perspective = ( projectionMatrix[ 2 ][ 3 ] == - 1.0 ); // 4th entry in the 3rd column

			if ( perspective ) {

				if ( start.z < 0.0 && end.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( start, end );
					end.xyz = mix( start.xyz, end.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceEnd = mix( lineDistanceStart, lineDistanceEnd, alpha );

					#endif

				} else if ( end.z < 0.0 && start.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( end, start );
					start.xyz = mix( end.xyz, start.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceStart = mix( lineDistanceEnd, lineDistanceStart, alpha );

					#endif

				}

			}

			#ifdef USE_DASH

				vLineDistance = ( position.y < 0.5 ) ? lineDistanceStart : lineDistanceEnd;
				vUv = uv;

			#endif

			// clip space
			vec4 clipStart = projectionMatrix * start;
			vec4 clipEnd = projectionMatrix * end;

			// ndc space
			vec3 ndcStart = clipStart.xyz / clipStart.w;
			vec3 ndcEnd = clipEnd.xyz / clipEnd.w;

			// direction
			vec2 dir = ndcEnd.xy - ndcStart.xy;

			// account for clip-space aspect ratio
			dir.x *= aspect;
			dir = normalize( dir );

			#ifdef WORLD_UNITS

				vec3 worldDir = normalize( end.xyz - start.xyz );
				vec3 tmpFwd = perspective ? normalize( mix( start.xyz, end.xyz, 0.5 ) ) : vec3( 0.0, 0.0, - 1.0 );
				vec3 worldUp = normalize( cross( worldDir, tmpFwd ) );
				vec3 worldFwd = cross( worldDir, worldUp );
				worldPos = position.y < 0.5 ? start: end;

				// height offset
				float hw = linewidth * 0.5;
				worldPos.xyz += position.x < 0.0 ? hw * worldUp : - hw * worldUp;

				// don't extend the line if we're rendering dashes because we
				// won't be rendering the endcaps
				#ifndef USE_DASH

					// cap extension
					worldPos.xyz += position.y < 0.5 ? - hw * worldDir : hw * worldDir;

					// add width to the box
					worldPos.xyz += worldFwd * hw;

					// endcaps
					if ( position.y > 1.0 || position.y < 0.0 ) {

						worldPos.xyz -= worldFwd * 2.0 * hw;

					}

				#endif

				// project the worldpos
				vec4 clip = projectionMatrix * worldPos;

				// shift the depth of the projected points so the line
				// segments overlap neatly
				vec3 clipPose = ( position.y < 0.5 ) ? ndcStart : ndcEnd;

				// only shift the depth of vertices in front of the camera (#35137)
				if ( clip.w > 0.0 ) clip.z = clipPose.z * clip.w;

			#else

				vec2 offset = vec2( dir.y, - dir.x );
				// undo aspect ratio adjustment
				dir.x /= aspect;
				offset.x /= aspect;

				// sign flip
				if ( position.x < 0.0 ) offset *= - 1.0;

				// endcaps
				if ( position.y < 0.0 ) {

					offset += - dir;

				} else if ( position.y > 1.0 ) {

					offset += dir;

				}

				// adjust for linewidth
				offset *= linewidth;

				// adjust for clip-space to screen-space conversion // maybe resolution should be based on viewport ...
				offset /= resolution.y;

				// select end
				vec4 clip = ( position.y < 0.5 ) ? clipStart : clipEnd;

				// back to clip space
				offset *= clip.w;

				clip.xy += offset;

			#endif

			gl_Position = clip;

			vec4 mvPosition = ( position.y < 0.5 ) ? start : end; // this is an approximation

			#include <logdepthbuf_vertex>
			#include <clipping_planes_vertex>
			#include <fog_vertex>

		}
		`,fragmentShader:`
		uniform vec3 diffuse;
		uniform float opacity;
		uniform float linewidth;

		#ifdef USE_DASH

			uniform float dashOffset;
			uniform float dashSize;
			uniform float gapSize;

		#endif

		varying float vLineDistance;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#include <common>
		#include <color_pars_fragment>
		#include <fog_pars_fragment>
		#include <logdepthbuf_pars_fragment>
		#include <clipping_planes_pars_fragment>

		vec2 closestLineToLine(vec3 p1, vec3 p2, vec3 p3, vec3 p4) {

			float mua;
			float mub;

			vec3 p13 = p1 - p3;
			vec3 p43 = p4 - p3;

			vec3 p21 = p2 - p1;

			float d1343 = dot( p13, p43 );
			float d4321 = dot( p43, p21 );
			float d1321 = dot( p13, p21 );
			float d4343 = dot( p43, p43 );
			float d2121 = dot( p21, p21 );

			float denom = d2121 * d4343 - d4321 * d4321;

			float numer = d1343 * d4321 - d1321 * d4343;

			mua = numer / denom;
			mua = clamp( mua, 0.0, 1.0 );
			mub = ( d1343 + d4321 * ( mua ) ) / d4343;
			mub = clamp( mub, 0.0, 1.0 );

			return vec2( mua, mub );

		}

		void main() {

			float alpha = opacity;
			vec4 diffuseColor = vec4( diffuse, alpha );

			#include <clipping_planes_fragment>

			#ifdef USE_DASH

				if ( vUv.y < - 1.0 || vUv.y > 1.0 ) discard; // discard endcaps

				if ( mod( vLineDistance + dashOffset, dashSize + gapSize ) > dashSize ) discard; // todo - FIX

			#endif

			#ifdef WORLD_UNITS

				float len;

				if ( isOrthographic ) {

					// View rays are parallel to the z axis so the distance reduces to camera-space XY
					vec2 lineDir = worldEnd.xy - worldStart.xy;
					float t = clamp( dot( worldPos.xy - worldStart.xy, lineDir ) / dot( lineDir, lineDir ), 0.0, 1.0 );
					len = length( worldStart.xy + lineDir * t - worldPos.xy );

				} else {

					// Find the closest points on the view ray and the line segment
					vec3 rayEnd = normalize( worldPos.xyz ) * 1e5;
					vec3 lineDir = worldEnd - worldStart;
					vec2 params = closestLineToLine( worldStart, worldEnd, vec3( 0.0, 0.0, 0.0 ), rayEnd );

					vec3 p1 = worldStart + lineDir * params.x;
					vec3 p2 = rayEnd * params.y;
					vec3 delta = p1 - p2;
					len = length( delta );

				}

				float norm = len / linewidth;

				#ifndef USE_DASH

					#ifdef USE_ALPHA_TO_COVERAGE

						float dnorm = fwidth( norm );
						alpha = 1.0 - smoothstep( 0.5 - dnorm, 0.5 + dnorm, norm );

					#else

						if ( norm > 0.5 ) {

							discard;

						}

					#endif

				#endif

			#else

				#ifdef USE_ALPHA_TO_COVERAGE

					// artifacts appear on some hardware if a derivative is taken within a conditional
					float a = vUv.x;
					float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
					float len2 = a * a + b * b;
					float dlen = fwidth( len2 );

					if ( abs( vUv.y ) > 1.0 ) {

						alpha = 1.0 - smoothstep( 1.0 - dlen, 1.0 + dlen, len2 );

					}

				#else

					if ( abs( vUv.y ) > 1.0 ) {

						float a = vUv.x;
						float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
						float len2 = a * a + b * b;

						if ( len2 > 1.0 ) discard;

					}

				#endif

			#endif

			#include <logdepthbuf_fragment>
			#include <color_fragment>

			gl_FragColor = vec4( diffuseColor.rgb, alpha );

			#include <tonemapping_fragment>
			#include <colorspace_fragment>
			#include <fog_fragment>
			#include <premultiplied_alpha_fragment>

		}
		`};var er=class extends pe{constructor(t){super({type:"LineMaterial",uniforms:jr.clone(Ze.line.uniforms),vertexShader:Ze.line.vertexShader,fragmentShader:Ze.line.fragmentShader,clipping:!0}),this.isLineMaterial=!0,this.setValues(t)}get color(){return this.uniforms.diffuse.value}set color(t){this.uniforms.diffuse.value=t}get worldUnits(){return"WORLD_UNITS"in this.defines}set worldUnits(t){t===!0!==this.worldUnits&&(this.needsUpdate=!0),t===!0?this.defines.WORLD_UNITS="":delete this.defines.WORLD_UNITS}get linewidth(){return this.uniforms.linewidth.value}set linewidth(t){this.uniforms.linewidth&&(this.uniforms.linewidth.value=t)}get dashed(){return"USE_DASH"in this.defines}set dashed(t){t===!0!==this.dashed&&(this.needsUpdate=!0),t===!0?this.defines.USE_DASH="":delete this.defines.USE_DASH}get dashScale(){return this.uniforms.dashScale.value}set dashScale(t){this.uniforms.dashScale.value=t}get dashSize(){return this.uniforms.dashSize.value}set dashSize(t){this.uniforms.dashSize.value=t}get dashOffset(){return this.uniforms.dashOffset.value}set dashOffset(t){this.uniforms.dashOffset.value=t}get gapSize(){return this.uniforms.gapSize.value}set gapSize(t){this.uniforms.gapSize.value=t}get opacity(){return this.uniforms.opacity.value}set opacity(t){this.uniforms&&(this.uniforms.opacity.value=t)}get resolution(){return this.uniforms.resolution.value}set resolution(t){this.uniforms.resolution.value.copy(t)}get alphaToCoverage(){return"USE_ALPHA_TO_COVERAGE"in this.defines}set alphaToCoverage(t){this.defines&&(t===!0!==this.alphaToCoverage&&(this.needsUpdate=!0),t===!0?this.defines.USE_ALPHA_TO_COVERAGE="":delete this.defines.USE_ALPHA_TO_COVERAGE)}};var Rg=new rn,tc=new F,is=class extends zr{constructor(){super(),this.isLineSegmentsGeometry=!0,this.type="LineSegmentsGeometry";let t=[-1,2,0,1,2,0,-1,1,0,1,1,0,-1,0,0,1,0,0,-1,-1,0,1,-1,0],e=[-1,2,1,2,-1,1,1,1,-1,-1,1,-1,-1,-2,1,-2],i=[0,2,1,2,3,1,2,4,3,4,5,3,4,6,5,6,7,5];this.setIndex(i),this.setAttribute("position",new ke(t,3)),this.setAttribute("uv",new ke(e,2))}applyMatrix4(t){let e=this.attributes.instanceStart,i=this.attributes.instanceEnd;return e!==void 0&&(e.applyMatrix4(t),i.applyMatrix4(t),e.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}setPositions(t){let e;t instanceof Float32Array?e=t:Array.isArray(t)&&(e=new Float32Array(t));let i=new Ci(e,6,1);return this.setAttribute("instanceStart",new Cn(i,3,0)),this.setAttribute("instanceEnd",new Cn(i,3,3)),this.instanceCount=this.attributes.instanceStart.count,this.computeBoundingBox(),this.computeBoundingSphere(),this}setColors(t){let e;t instanceof Float32Array?e=t:Array.isArray(t)&&(e=new Float32Array(t));let i=new Ci(e,6,1);return this.setAttribute("instanceColorStart",new Cn(i,3,0)),this.setAttribute("instanceColorEnd",new Cn(i,3,3)),this}fromWireframeGeometry(t){return this.setPositions(t.attributes.position.array),this}fromEdgesGeometry(t){return this.setPositions(t.attributes.position.array),this}fromMesh(t){return this.fromWireframeGeometry(new Or(t.geometry)),this}fromLineSegments(t){let e=t.geometry;return this.setPositions(e.attributes.position.array),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new rn);let t=this.attributes.instanceStart,e=this.attributes.instanceEnd;t!==void 0&&e!==void 0&&(this.boundingBox.setFromBufferAttribute(t),Rg.setFromBufferAttribute(e),this.boundingBox.union(Rg))}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new an),this.boundingBox===null&&this.computeBoundingBox();let t=this.attributes.instanceStart,e=this.attributes.instanceEnd;if(t!==void 0&&e!==void 0){let i=this.boundingSphere.center;this.boundingBox.getCenter(i);let s=0;for(let r=0,a=t.count;r<a;r++)tc.fromBufferAttribute(t,r),s=Math.max(s,i.distanceToSquared(tc)),tc.fromBufferAttribute(e,r),s=Math.max(s,i.distanceToSquared(tc));this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error("THREE.LineSegmentsGeometry.computeBoundingSphere(): Computed radius is NaN. The instanced position data is likely to have NaN values.",this)}}toJSON(){}};var _u=new Kt,Ig=new F,Pg=new F,Le=new Kt,Ne=new Kt,Xn=new Kt,yu=new F,vu=new ie,De=new Vr,Lg=new F,ec=new rn,nc=new an,qn=new Kt,$n,ss;function Ng(n,t,e){return qn.set(0,0,-t,1).applyMatrix4(n.projectionMatrix),qn.multiplyScalar(1/qn.w),qn.x=ss/e.width,qn.y=ss/e.height,qn.applyMatrix4(n.projectionMatrixInverse),qn.multiplyScalar(1/qn.w),Math.abs(Math.max(qn.x,qn.y))}function P1(n,t){let e=n.matrixWorld,i=n.geometry,s=i.attributes.instanceStart,r=i.attributes.instanceEnd,a=Math.min(i.instanceCount,s.count);for(let o=0,l=a;o<l;o++){De.start.fromBufferAttribute(s,o),De.end.fromBufferAttribute(r,o),De.applyMatrix4(e);let c=new F,h=new F;$n.distanceSqToSegment(De.start,De.end,h,c),h.distanceTo(c)<ss*.5&&t.push({point:h,pointOnLine:c,distance:$n.origin.distanceTo(h),object:n,face:null,faceIndex:o,uv:null,uv1:null})}}function L1(n,t,e){let i=t.projectionMatrix,r=n.material.resolution,a=n.matrixWorld,o=n.geometry,l=o.attributes.instanceStart,c=o.attributes.instanceEnd,h=Math.min(o.instanceCount,l.count),f=-t.near;$n.at(1,Xn),Xn.w=1,Xn.applyMatrix4(t.matrixWorldInverse),Xn.applyMatrix4(i),Xn.multiplyScalar(1/Xn.w),Xn.x*=r.x/2,Xn.y*=r.y/2,Xn.z=0,yu.copy(Xn),vu.multiplyMatrices(t.matrixWorldInverse,a);for(let u=0,d=h;u<d;u++){if(Le.fromBufferAttribute(l,u),Ne.fromBufferAttribute(c,u),Le.w=1,Ne.w=1,Le.applyMatrix4(vu),Ne.applyMatrix4(vu),Le.z>f&&Ne.z>f)continue;if(Le.z>f){let A=Le.z-Ne.z,b=(Le.z-f)/A;Le.lerp(Ne,b)}else if(Ne.z>f){let A=Ne.z-Le.z,b=(Ne.z-f)/A;Ne.lerp(Le,b)}Le.applyMatrix4(i),Ne.applyMatrix4(i),Le.multiplyScalar(1/Le.w),Ne.multiplyScalar(1/Ne.w),Le.x*=r.x/2,Le.y*=r.y/2,Ne.x*=r.x/2,Ne.y*=r.y/2,De.start.copy(Le),De.start.z=0,De.end.copy(Ne),De.end.z=0;let _=De.closestPointToPointParameter(yu,!0);De.at(_,Lg);let p=Kh.lerp(Le.z,Ne.z,_),g=p>=-1&&p<=1,M=yu.distanceTo(Lg)<ss*.5;if(g&&M){De.start.fromBufferAttribute(l,u),De.end.fromBufferAttribute(c,u),De.start.applyMatrix4(a),De.end.applyMatrix4(a);let A=new F,b=new F;$n.distanceSqToSegment(De.start,De.end,b,A),e.push({point:b,pointOnLine:A,distance:$n.origin.distanceTo(b),object:n,face:null,faceIndex:u,uv:null,uv1:null})}}}var ic=class extends de{constructor(t=new is,e=new er({color:Math.random()*16777215})){super(t,e),this.isLineSegments2=!0,this.type="LineSegments2"}computeLineDistances(){let t=this.geometry,e=t.attributes.instanceStart,i=t.attributes.instanceEnd,s=new Float32Array(2*e.count);for(let a=0,o=0,l=e.count;a<l;a++,o+=2)Ig.fromBufferAttribute(e,a),Pg.fromBufferAttribute(i,a),s[o]=o===0?0:s[o-1],s[o+1]=s[o]+Ig.distanceTo(Pg);let r=new Ci(s,2,1);return t.setAttribute("instanceDistanceStart",new Cn(r,1,0)),t.setAttribute("instanceDistanceEnd",new Cn(r,1,1)),this}raycast(t,e){let i=this.material.worldUnits,s=t.camera;if(s===null&&!i&&console.error('LineSegments2: "Raycaster.camera" needs to be set in order to raycast against LineSegments2 while worldUnits is set to false.'),i===!1&&(this.material.resolution.x===0||this.material.resolution.y===0))return;let r=t.params.Line2!==void 0&&t.params.Line2.threshold||0;$n=t.ray;let a=this.matrixWorld,o=this.geometry,l=this.material;ss=l.linewidth+r,o.boundingSphere===null&&o.computeBoundingSphere(),nc.copy(o.boundingSphere).applyMatrix4(a);let c;if(i)c=ss*.5;else{let f=Math.max(s.near,nc.distanceToPoint($n.origin));c=Ng(s,f,l.resolution)}if(nc.radius+=c,$n.intersectsSphere(nc)===!1)return;o.boundingBox===null&&o.computeBoundingBox(),ec.copy(o.boundingBox).applyMatrix4(a);let h;if(i)h=ss*.5;else{let f=Math.max(s.near,ec.distanceToPoint($n.origin));h=Ng(s,f,l.resolution)}ec.expandByScalar(h),$n.intersectsBox(ec)!==!1&&(i?P1(this,e):L1(this,s,e))}onBeforeRender(t){let e=this.material.uniforms;e&&e.resolution&&(t.getViewport(_u),this.material.uniforms.resolution.value.set(_u.z,_u.w))}};var bu=1,nr=2,sc=class{constructor(t,e,i){this.run=t,this.frames=e,this.colours=i,this.mesh=new Xl(e.rest,e.triangles),this.size=e.head.size,this.middle=N1(e.rest),this.anchor={centre:this.middle,size:this.size},this.orbit=new Ql,this.camera=Eg(),this.light=eg(i),this.light.size.value=this.size,this.scene=new Mi,this.cloth=new Hl(this.mesh,this.light,i),this.cloth.caster.layers.set(bu),this.scene.add(this.cloth.caster),this.#t(),this.#n(),this.#e(),this.#i(),this.picked=new rc(this),this.frame=-1,this.shadowDue=!0}#t(){let t=this.frames.obstacles.length?rg(this.light,this.colours):null;this.obstacles=this.frames.obstacles.map(({points:e,triangles:i,velocity:s})=>{let r=U1(e,i),a=new ve;a.setAttribute("position",new re(e,3)),a.setAttribute("normal",new re(r,3)),a.setIndex(new re(i,1));let o=new de(a,t);return o.frustumCulled=!1,o.layers.enable(bu),this.scene.add(o),{drawn:o,velocity:s}})}#n(){let{floor:t,box:e}=this.frames.head,i=t??e[0][2]-.06*this.size;this.floor=new de(new Gn(2,2),ag(this.light)),this.floor.position.z=i,this.floor.frustumCulled=!1,this.floor.material.uniforms.middle.value.set(...[0,1].map(s=>(e[0][s]+e[1][s])/2),i),this.scene.add(this.floor)}#e(){let{pinned:t,seeds:e}=this.frames,i=new Set(e),s=[...t].sort((a,o)=>i.has(a)-i.has(o));this.pins=Uint32Array.from(s);let r=new ve;r.setAttribute("position",new re(new Float32Array(3*s.length),3)),r.setAttribute("wide",new re(Float32Array.from(s,a=>s.length>40?3.5:i.has(a)?e.length>8?6:8:4.5),1)),this.pinMarks=new Ki(r,Su("#1f2429")),this.pinMarks.frustumCulled=!1,this.pinMarks.layers.set(nr),this.scene.add(this.pinMarks)}#i(){this.shadowCamera=new Ei(-1,1,1,-1,0,1),this.shadowCamera.layers.set(bu),this.shadowMaterial=og(),this.light.shadowMatrix.value=new ie}#s(t){if(this.shadowTarget?.width===t)return this.shadowTarget;this.shadowTarget?.depthTexture.dispose(),this.shadowTarget?.dispose();let e=new on(t,t,Ye);return e.compareFunction=Jr,e.magFilter=e.minFilter=fe,this.shadowTarget=new Ie(t,t,{depthTexture:e,minFilter:ue,magFilter:ue}),this.light.shadowMap.value=e,this.shadowTarget}#a(){let t=new F(...this.colours.light),{low:e,high:i}=D1(this.cloth.positions),s=e.map((c,h)=>(c+i[h])/2),r=Math.max(.57*Math.hypot(...i.map((c,h)=>c-e[h])),.05*this.size),a=this.shadowCamera,o=20*r;a.position.set(...s).addScaledVector(t,o/2),a.up.set(0,1,0),a.lookAt(new F(...s)),Object.assign(a,{left:-r,right:r,bottom:-r,top:r,near:0,far:o}),a.updateProjectionMatrix(),a.updateMatrixWorld(),this.light.shadowMatrix.value.set(.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1).multiply(a.projectionMatrix).multiply(a.matrixWorldInverse);let l=(this.floor.position.z-s[2])/t.z;this.floor.position.setX(s[0]+l*t.x).setY(s[1]+l*t.y),this.floor.scale.set(r*1.1/t.z,r*1.1/t.z,1),this.light.shadowTexel.value=.0042*this.size/(2*r)*.6}goTo(t){let e=this.frames.frameAt(t);if(e===this.frame)return!1;this.frame=e,this.frames.positions(e,this.cloth.positions),this.cloth.moved();for(let{drawn:s,velocity:r}of this.obstacles)s.position.set(...r.map(a=>a*this.frames.times[e]));let i=this.pinMarks.geometry.getAttribute("position");return this.pins.forEach((s,r)=>i.array.set(this.cloth.positions.subarray(3*s,3*s+3),3*r)),i.needsUpdate=!0,this.picked.moved(),this.shadowDue=!0,!0}get time(){return this.frames.times[this.frame]}overlay(t){this.ghost&&this.scene.remove(this.ghost),this.ghost=null,!(!t||t===this)&&(this.ghostMaterial??=sg(this.light),this.ghost=new de(t.cloth.shared,this.ghostMaterial),this.ghost.frustumCulled=!1,this.ghost.renderOrder=2,this.scene.add(this.ghost))}sample(){let t=[],e=this.frames.decoded-1,i=new Set([0,this.frame,...[.2,.4,.6,.8,1].map(a=>Math.round(a*e))]),s=Math.max(1,Math.floor(this.mesh.vertexCount/600)),r=new Float32Array(3*this.mesh.vertexCount);for(let a of i)if(!(a<0||a>e)){this.frames.positions(a,r);for(let o=0;o<r.length;o+=3*s)Math.hypot(r[o]-this.middle[0],r[o+1]-this.middle[1],r[o+2]-this.middle[2])<1.6*this.size&&t.push(r[o],r[o+1],r[o+2])}return t}drawShadow(t,e){this.light.shadowed.value=e>0,e&&(!this.shadowDue&&this.shadowTarget?.width===e||(this.shadowDue&&this.#a(),t.setRenderTarget(this.#s(e)),t.setScissorTest(!1),t.clear(),this.scene.overrideMaterial=this.shadowMaterial,t.render(this.scene,this.shadowCamera),this.scene.overrideMaterial=null,this.shadowDue=!1))}dispose(){this.cloth.dispose(),this.shadowTarget?.depthTexture.dispose(),this.shadowTarget?.dispose(),this.shadowMaterial.dispose(),this.overlay(null),this.scene.traverse(t=>{t.geometry?.dispose(),t.material?.dispose?.()})}};function Dg(n){let t=[];for(let i of n){let s=t.find(([r])=>Math.abs(r.size/i.size-1)<.01&&Math.hypot(...r.middle.map((a,o)=>a-i.middle[o]))<.01*i.size);s?s.push(i):t.push([i])}let e=new Map;for(let i of t){let s=i.map(l=>l.sample()),{low:r,high:a}=Mu(s.flat()),o={centre:r.map((l,c)=>(l+a[c])/2),size:Math.hypot(...a.map((l,c)=>l-r[c]))||i[0].size};i.forEach((l,c)=>{l.anchor=o,e.set(l,s[c].map((h,f)=>(h-o.centre[f%3])/o.size))})}return n.map(i=>e.get(i))}function N1(n){let{low:t,high:e}=Mu(n);return t.map((i,s)=>(i+e[s])/2)}function D1(n){let t=3*Math.max(1,Math.floor(n.length/3/1500)),e=[];for(let i=0;i<n.length;i+=t)e.push(n[i],n[i+1],n[i+2]);return Mu(e)}function Mu(n){let t=[1/0,1/0,1/0],e=[-1/0,-1/0,-1/0];return n.forEach((i,s)=>{t[s%3]=Math.min(t[s%3],i),e[s%3]=Math.max(e[s%3],i)}),{low:t,high:e}}function U1(n,t){let e=new Float32Array(n.length);return pu(n,t,e),e}function Su(n){return new pe({glslVersion:yn,transparent:!0,depthWrite:!1,uniforms:{tint:{value:new Yt(n).convertLinearToSRGB()},ratio:{value:1}},vertexShader:`
      in float wide;
      uniform float ratio;
      out float radius;
      void main() {
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        gl_Position.z -= 0.004 * gl_Position.w;
        radius = 0.5 * wide * ratio;
        gl_PointSize = 2.0 * radius + 3.0 * ratio;
      }`,fragmentShader:`
      uniform vec3 tint;
      uniform float ratio;
      in float radius;
      layout(location = 0) out vec4 colour;
      void main() {
        float far = length(gl_PointCoord - 0.5) * (2.0 * radius + 3.0 * ratio);
        float inside = clamp(radius + 0.5 - far, 0.0, 1.0), ring = clamp(radius + ratio + 0.5 - far, 0.0, 1.0);
        if (ring <= 0.0) discard;
        colour = vec4(mix(vec3(1.0), tint, inside), ring);
      }`})}var F1="#c1121f",O1="#1d4e89",rc=class{constructor(t){this.view=t,this.vertex=null,this.triangle=null,this.springs=[],this.read=!0,this.rings=t.colours.rings,this.lines=this.#t(2.2),this.arrows=this.#t(2.4);let e=new ve;e.setAttribute("position",new re(new Float32Array(3),3)),e.setAttribute("wide",new re(Float32Array.of(9),1)),this.mark=new Ki(e,Su("#c1121f")),this.mark.frustumCulled=!1,this.mark.layers.set(nr),this.mark.visible=!1,t.scene.add(this.mark)}#t(t){let e=new ic(new is,new er({vertexColors:!0,linewidth:t,transparent:!0,depthTest:!1,toneMapped:!1}));return e.onBeforeRender=()=>{},e.frustumCulled=!1,e.layers.set(nr),e.visible=!1,e.renderOrder=5,this.view.scene.add(e),e}set(t,e,i){this.vertex=t,this.triangle=e,this.springs=i??[],this.read=i!==null,this.moved()}moved(){this.#n(),this.#e()}#n(){if(this.mark.visible=this.vertex!==null,this.lines.visible=this.vertex!==null&&this.springs.length>0,this.vertex===null)return;let{positions:t}=this.view.cloth,e=[...t.subarray(3*this.vertex,3*this.vertex+3)];if(this.mark.geometry.getAttribute("position").array.set(e),this.mark.geometry.getAttribute("position").needsUpdate=!0,!this.springs.length)return;let i=[],s=[];for(let{ring:r,others:a}of this.springs.toReversed()){let o=wu(this.rings[(r-1+this.rings.length)%this.rings.length]);for(let l of a)i.push(...e,...t.subarray(3*l,3*l+3)),s.push(...o,...o)}Ug(this.lines,i,s)}#e(){if(this.arrows.visible=this.triangle!==null,this.triangle===null)return;let{mesh:t,cloth:{positions:e}}=this.view,i=[0,1,2].map(f=>{let u=3*t.triangles[3*this.triangle+f];return[...e.subarray(u,u+3)]}),s=[0,1,2].map(f=>(i[0][f]+i[1][f]+i[2][f])/3),r=[],a=[],o=(f,u,d)=>{r.push(...f,...u),a.push(...d,...d)};for(let f=0;f<3;++f)o(i[f],i[(f+1)%3],wu("#1f2429"));let l=Math.max(.09*this.view.size,2*Math.sqrt(t.frames.areas[this.triangle])),c=Qs(t,e,this.triangle),h=fg(t,e,this.triangle);h.forEach((f,u)=>{let d=wu(c[u]>=1?F1:O1),m=f.map(p=>.5*l*p),_=h[1-u].map(p=>.5*l*p/(c[1-u]||1));for(let p of[1,-1]){let g=s.map((A,b)=>A+p*m[b]);o(s,g,d);let M=c[u]>=1?.78:1.22;for(let A of[1,-1])o(g,s.map((b,E)=>b+p*M*m[E]+A*.13*_[E]),d)}}),Ug(this.arrows,r,a)}resize(t,e,i){for(let s of[this.lines,this.arrows])s.material.resolution.set(t/i,e/i);this.mark.material.uniforms.ratio.value=i}};function wu(n){return[1,3,5].map(t=>parseInt(n.slice(t,t+2),16)/255)}function Ug(n,t,e){n.geometry.dispose(),n.geometry=new is,n.geometry.setPositions(t),n.geometry.setColors(e)}function Fg(n,t,e){let i=n.ringsFrom(e),s=new Map;for(let{columns:r,vertices:a}of t)for(let o=0;o<a.length;o+=r){let l=!1;for(let u=0;u<r;++u)l||=a[o+u]===e;if(!l)continue;let c=[...a.subarray(o,o+r)].filter(u=>u!==e),h=Math.max(...c.map(u=>i[u])),f=s.get(h)??{ring:h,others:[],count:0};f.others.push(...c),f.count+=1,s.set(h,f)}return[...s.values()].sort((r,a)=>r.ring-a.ring)}var B1=Uint32Array.from({length:256},(n,t)=>{for(let e=0;e<8;++e)t=t&1?3988292384^t>>>1:t>>>1;return t>>>0});function k1(n){let t=4294967295;for(let e of n)t=B1[(t^e)&255]^t>>>8;return(t^4294967295)>>>0}function ir(n,t){let e=new Uint8Array(12+t.length),i=new DataView(e.buffer);i.setUint32(0,t.length);for(let s=0;s<4;++s)e[4+s]=n.charCodeAt(s);return e.set(t,8),i.setUint32(8+t.length,k1(e.subarray(4,8+t.length))),e}function Au(...n){let t=new Uint8Array(n.reduce((s,[r])=>s+r,0)),e=new DataView(t.buffer),i=0;for(let[s,r]of n)s===4?e.setUint32(i,r):s===2?e.setUint16(i,r):e.setUint8(i,r),i+=s;return t}async function z1(n){let t=new Blob([n]).stream().pipeThrough(new CompressionStream("deflate"));return new Uint8Array(await new Response(t).arrayBuffer())}function V1({data:n,width:t,height:e}){let i=new Uint8Array(e*(1+3*t));for(let s=0,r=0;s<e;++s){i[r++]=2;for(let a=0,o=4*s*t;a<t;++a,o+=4)for(let l=0;l<3;++l)i[r++]=n[o+l]-(s?n[o+l-4*t]:0)}return i}var ac=class{constructor(){this.pictures=[]}async add(t,e){this.size=[t.width,t.height],this.pictures.push({data:await z1(V1(t)),milliseconds:Math.round(1e3*e)})}blob(){let[t,e]=this.size,i=0,s=[Uint8Array.of(137,80,78,71,13,10,26,10),ir("IHDR",Au([4,t],[4,e],[1,8],[1,2],[1,0],[1,0],[1,0])),ir("acTL",Au([4,this.pictures.length],[4,0]))];return this.pictures.forEach(({data:r,milliseconds:a},o)=>{if(s.push(ir("fcTL",Au([4,i++],[4,t],[4,e],[4,0],[4,0],[2,a],[2,1e3],[1,0],[1,0]))),o===0)s.push(ir("IDAT",r));else{let l=new Uint8Array(4+r.length);new DataView(l.buffer).setUint32(0,i++),l.set(r,4),s.push(ir("fdAT",l))}}),s.push(ir("IEND",new Uint8Array)),new Blob(s,{type:"image/png"})}};function Og(n,{canvas:t,ratio:e,cells:i,time:s,bar:r,look:a}){let{width:o,height:l}=n.canvas;n.fillStyle=a.paper,n.fillRect(0,0,o,l),n.drawImage(t,0,0);let c=(f,u=400)=>`${u} ${f*e}px system-ui, "DejaVu Sans", sans-serif`;n.textBaseline="top",n.textAlign="left";for(let{x:f,y:u,width:d,label:m}of i)n.font=c(13,600),n.fillStyle=a.label,n.fillText(H1(n,m,(d-20)*e),(f+10)*e,(u+8)*e);let h=t.height+10*e;n.font=c(13),n.fillStyle=a.ink,n.fillText(`t = ${s.toFixed(2)} s`,10*e,h),r&&G1(n,r,c,e,h)}var Bg=40;function G1(n,{quantity:t,range:e,colours:i},s,r,a){let o=Math.min(220*r,n.canvas.width*.4),c=n.canvas.width-14*r-o;for(let d=0;d<256;++d)n.fillStyle=`#${i.substr(6*d,6)}`,n.fillRect(c+d*o/256,a,o/256+1,9*r);let h=n.canvas.dataset.ink;n.fillStyle=h,n.font=s(10.5),n.textAlign="center";let f=[{share:0,text:String(Number(e[0].toPrecision(3)))},{share:1,text:String(Number(e[1].toPrecision(3)))}];for(let{share:d,text:m}of[...f,...xu(t,e)])n.fillText(m,c+d*o,a+12*r);n.textAlign="right",n.font=s(12);let u=t.unit&&t.unit!=="1"?` (${t.unit})`:"";n.fillText(`${t.name}${t.symbol?`, ${t.symbol}`:""}${u}`,c-14*r,a-r)}function H1(n,t,e){if(n.measureText(t).width<=e)return t;let i=t.length;for(;i>1&&n.measureText(`${t.slice(0,i)}\u2026`).width>e;)--i;return`${t.slice(0,i)}\u2026`}function kg(){return typeof MediaRecorder>"u"?null:["video/webm;codecs=vp8","video/webm;codecs=vp9","video/webm"].find(n=>MediaRecorder.isTypeSupported(n))??null}async function zg(n,t,e){let i=n.captureStream(0),[s]=i.getVideoTracks(),r=new MediaRecorder(i,{mimeType:t,videoBitsPerSecond:12e6}),a=[];r.ondataavailable=l=>l.data.size&&a.push(l.data);let o=new Promise((l,c)=>{r.onstop=l,r.onerror=h=>c(h.error??new Error("the browser stopped recording"))});return r.start(),await e(()=>s.requestFrame()),r.stop(),await o,s.stop(),new Blob(a,{type:"video/webm"})}var Vg=15,W1=1,oc=class{constructor(t){this.player=t,this.recording=!1,this.slowest=100}#t(t=!1){let{player:e}=this,i=document.createElement("canvas");i.width=e.controls.canvas.width,i.height=e.controls.canvas.height+Math.round(Bg*e.stage.ratio);let s=getComputedStyle(e.element),r={paper:s.getPropertyValue("--paper").trim()||"#fff",ink:s.getPropertyValue("--ink").trim()||"#222",label:s.getPropertyValue("--ink").trim()||"#222"};return i.dataset.ink=r.ink,{canvas:i,look:r,context:i.getContext("2d",{willReadFrequently:t})}}#n({context:t,look:e}){let{player:i}=this,s=i.reference,r=i.compare.quantity(i.key,s);Og(t,{canvas:i.controls.canvas,ratio:i.stage.ratio,time:i.time,look:e,cells:i.cells.map(({view:a,x:o,y:l,width:c})=>({x:o,y:l,width:c,label:a.run.label})),bar:r.map?{quantity:r,range:i.compare.range(i.key,i.views,s),colours:Xt().colours.maps[r.map]}:null})}#e(t){return`${this.player.views.map(i=>i.run.label).join("_").replace(/[^\p{L}\p{N}_.=-]+/gu,"-").slice(0,80)}${t}`}async still(){let{player:t}=this;if(!t.views.length)return null;t.stop(),t.drawNow();let e=this.#t();this.#n(e);let i=await new Promise(s=>e.canvas.toBlob(s,"image/png"));return ar(this.#e(`-${t.time.toFixed(2)}s.png`),i),t.controls.say("Picture saved."),i}async animation(){let{player:t}=this;if(!t.views.length)return null;if(this.recording)return this.recording=!1,null;t.stop(),this.recording=!0,t.controls.update();let e=t.time,{stage:i}=t,s=i.movingLevel;i.movingLevel=Math.min(s,W1),t.drawNow(!0,!0);let r=this.#t(!0),a=kg(),o=a&&this.#s(r)<=this.slowest?a:null;try{let l=o?await zg(r.canvas,o,c=>this.#i(r,c)):await this.#l(r);return ar(this.#e(o?".webm":".png"),l),t.controls.say(o?"Animation saved.":"Animation saved as animated PNG."),l}catch(l){return t.controls.say(`No animation was saved: ${l.message}`),null}finally{this.recording=!1,i.movingLevel=s,t.controls.update(),t.seek(e)}}#i(t,e){let{player:i}=this;return new Promise(s=>{let r=null,a=o=>{i.time=r===null?i.first:Math.min(i.first+Math.max(0,o-r)/1e3*i.speed,i.last),i.drawNow(!0,!0),this.#n(t),e(),r??=performance.now(),i.controls.say(`Recording, ${Math.round(100*this.#r())} % \u2026`),i.time<i.last&&this.recording?requestAnimationFrame(a):this.#a(e).then(s)};requestAnimationFrame(a)})}#s(t){let e=performance.now();for(let i=0;i<3;++i)this.player.drawNow(!0,!0),this.#n(t),t.context.getImageData(0,0,1,1);return(performance.now()-e)/3}async#a(t){for(let e=0;e<6;++e)await new Promise(i=>setTimeout(i,120)),t()}#r(){let{first:t,last:e,time:i}=this.player;return e>t?(i-t)/(e-t):1}async#l(t){let{player:e}=this,i=new ac,s=e.speed/Vg,r=Math.max(1,Math.ceil((e.last-e.first)/s));for(let a=0;a<=r&&this.recording;++a){e.time=Math.min(e.first+a*s,e.last),e.drawNow(!0,!0),this.#n(t);let{width:o,height:l}=t.canvas;await i.add(t.context.getImageData(0,0,o,l),a===r?1:1/Vg),e.controls.say(`Recording, ${Math.round(100*this.#r())} % \u2026`)}return i.blob()}};var X1=18,q1=26,lc=[{ratio:2,samples:4,rings:3,turns:6,taps:10,shadow:1024,quick:!1},{ratio:1,samples:0,rings:2,turns:3,taps:4,shadow:1024,quick:!1},{ratio:.75,samples:0,rings:2,turns:2,taps:2,shadow:512,quick:!0},{ratio:.5,samples:0,rings:0,turns:0,taps:1,shadow:512,quick:!0}],$1=5e4,Y1=/swiftshader|llvmpipe|software|basic render/i,cc=class{constructor(t){this.canvas=t,this.renderer=new kl({canvas:t,antialias:!1,alpha:!1,powerPreference:"high-performance"}),this.renderer.autoClear=!1,this.renderer.outputColorSpace=Zi,this.renderer.setClearColor(16777215,1),this.ground={top:new F,bottom:new F},this.quad=new de(new Gn(2,2),this.#n()),this.quad.frustumCulled=!1,this.quadScene=new Mi,this.quadScene.add(this.quad),this.quadCamera=new Ei(-1,1,1,-1,0,1),this.backdrop=new de(new Gn(2,2),Z1(this.ground)),this.backdrop.frustumCulled=!1,this.backdropScene=new Mi,this.backdropScene.add(this.backdrop),this.movingLevel=Y1.test(this.#t())?lc.length-1:0,this.level=this.movingLevel,this.finest=0,this.times=[]}#t(){let t=this.renderer.getContext(),e=t.getExtension("WEBGL_debug_renderer_info");return e?String(t.getParameter(e.UNMASKED_RENDERER_WEBGL)):""}#n(){return new pe({glslVersion:yn,depthTest:!1,depthWrite:!1,uniforms:{picture:{value:null},depth:{value:null},near:{value:1},far:{value:1},size:{value:1},texel:{value:new $t},bounds:{value:new Kt},rings:{value:3},turns:{value:4}},vertexShader:"out vec2 place; void main() { place = 0.5 * position.xy + 0.5; gl_Position = vec4(position.xy, 0.0, 1.0); }",fragmentShader:`
        uniform sampler2D picture, depth;
        uniform float near, far, size;
        uniform vec2 texel;
        uniform vec4 bounds;
        uniform int rings, turns;
        in vec2 place;
        layout(location = 0) out vec4 colour;
        float depthAt(vec2 at) {
          float z = texture(depth, clamp(at, bounds.xy, bounds.zw)).r;
          return z >= 1.0 ? 1e9 : near * far / (far - z * (far - near));
        }
        void main() {
          vec2 at = mix(bounds.xy, bounds.zw, place);
          colour = vec4(texture(picture, at).rgb, 1.0);
          float here = depthAt(at);
          if (here > 1e8) return;
          float height = bounds.w - bounds.y, total = 0.0;
          float turned = 6.2832 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
          for (int r = 0; r < rings; ++r) {
            float reach = height * (r == 0 ? 0.010 : r == 1 ? 0.022 : 0.042);
            for (int k = 0; k < turns; ++k) {
              float angle = 3.14159 * (float(k) + turned / 6.2832) / float(turns) + float(r);
              vec2 shift = reach * vec2(cos(angle) * texel.x / texel.y, sin(angle));
              float one = here - depthAt(at + shift), other = here - depthAt(at - shift);
              if (abs(one) < 0.15 * size && abs(other) < 0.15 * size)
                total += clamp((one + other) / (0.012 * size), 0.0, 1.0);
            }
          }
          colour.rgb *= pow(1.0 - 0.72 * total / float(rings * turns), 1.0 / 2.2);
        }`})}resize(t,e){[this.width,this.height]=[t,e],this.#e()}#e(){this.ratio=Math.min(devicePixelRatio||1,lc[this.level].ratio);let t=[this.width,this.height].map(e=>Math.max(1,Math.round(e*this.ratio)));t[0]===this.canvas.width&&t[1]===this.canvas.height||(this.renderer.setPixelRatio(1),this.renderer.setSize(...t,!1),this.#i())}#i(){this.target?.depthTexture.dispose(),this.target?.dispose(),this.target=null}#s({samples:t,rings:e}){if(!e)return null;if(this.target?.samples!==t&&this.#i(),this.target)return this.target;let{width:i,height:s}=this.canvas;return this.target=new Ie(i,s,{samples:t,minFilter:fe,magFilter:fe}),this.target.depthTexture=new on(i,s,Ye),this.target.depthTexture.minFilter=this.target.depthTexture.magFilter=ue,this.target}draw(t,e=!1){let i=e?this.movingLevel:0;i!==this.level&&(this.level=i,this.#e());let{renderer:s,ratio:r}=this,a=lc[i],o=this.#s(a);for(let{view:c}of t)c.cloth.use(a.quick,c.scene),c.drawShadow(s,a.quick&&c.mesh.triangleCount>$1?0:a.shadow);s.setRenderTarget(o),s.setScissorTest(!1),s.setViewport(0,0,this.canvas.width,this.canvas.height),s.clear(),s.render(this.backdropScene,this.quadCamera);let l=t.map(({x:c,y:h,width:f,height:u})=>[Math.round(c*r),this.canvas.height-Math.round((h+u)*r),Math.round(f*r),Math.round(u*r)]);t.forEach(({view:c,width:h,height:f},u)=>{c.orbit.place(c.camera,c.anchor.centre,c.anchor.size,h/f),c.light.taps.value=a.taps,c.picked.resize(l[u][2],l[u][3],r),c.pinMarks.material.uniforms.ratio.value=r,this.#r(l[u],o),c.camera.layers.set(0),s.render(c.scene,c.camera),c.camera.layers.set(nr),s.render(c.scene,c.camera)}),o&&this.#a(t,l,a)}#a(t,e,{rings:i,turns:s}){let{renderer:r,canvas:a,target:o,quad:{material:{uniforms:l}}}=this;l.rings.value=i,l.turns.value=s,l.picture.value=o.texture,l.depth.value=o.depthTexture,l.texel.value.set(1/a.width,1/a.height),r.setRenderTarget(null),t.forEach(({view:c},h)=>{let[f,u,d,m]=e[h];l.near.value=c.camera.near,l.far.value=c.camera.far,l.size.value=c.size,l.bounds.value.set(f/a.width,u/a.height,(f+d)/a.width,(u+m)/a.height),this.#r(e[h]),r.render(this.quadScene,this.quadCamera)})}#r([t,e,i,s],r=null){r?(r.viewport.set(t,e,i,s),r.scissor.set(t,e,i,s),r.scissorTest=!0,this.renderer.setRenderTarget(r)):(this.renderer.setViewport(t,e,i,s),this.renderer.setScissor(t,e,i,s),this.renderer.setScissorTest(!0))}judge(t){if(this.times.push(t),this.times.length<9)return;let e=this.times.sort((i,s)=>i-s)[4];this.times=[],e>q1&&this.movingLevel<lc.length-1?this.finest=++this.movingLevel:e<X1&&this.movingLevel>this.finest&&--this.movingLevel}dispose(){this.#i(),this.quad.geometry.dispose(),this.quad.material.dispose(),this.backdrop.geometry.dispose(),this.backdrop.material.dispose(),this.renderer.dispose(),this.renderer.forceContextLoss()}};function Z1(n){return new pe({glslVersion:yn,depthTest:!1,depthWrite:!1,uniforms:{top:{value:n.top},bottom:{value:n.bottom}},vertexShader:"out float height; void main() { height = 0.5 * position.y + 0.5; gl_Position = vec4(position.xy, 1.0, 1.0); }",fragmentShader:`
      uniform vec3 top, bottom;
      in float height;
      layout(location = 0) out vec4 colour;
      void main() { colour = vec4(mix(bottom, top, height), 1.0); }`})}var J1=220,K1=120,j1=matchMedia("(prefers-reduced-motion: reduce)"),hc=class{constructor(t){this.element=t,this.ids=t.dataset.runs.split(" ").filter(Boolean),this.shownIds=this.ids.slice(0,Math.min(t.dataset.shown??8,8)),this.time=0,this.speed=1,this.loop=!1,this.linked=!0,this.lines=!0,this.key="stretch",this.referenceId=null,this.views=[],this.cells=[],this.drawn=0,this.compare=new $l(Xt().quantities),this.controls=new Kl(this),this.recorder=new oc(this),t.replaceChildren(...this.controls.parts),t.classList.add("player-ready"),t.setAttribute("role","group"),t.setAttribute("aria-label","Player of the cloth"),t.addEventListener("keydown",e=>Sg(this,e)),this.resizes=new ResizeObserver(()=>this.#s()),this.resizes.observe(this.controls.stage),this.theme=matchMedia("(prefers-color-scheme: dark)"),this.theme.addEventListener("change",this.#r),this.print=matchMedia("print"),this.print.addEventListener("change",this.#l),t.addEventListener("fullscreenchange",()=>this.#s())}async start(){let t=this.turn={};this.playing=!1,this.#i();let e=this.shownIds.map(qa);if(this.controls.showCells(e),e.some(s=>s.frames)&&!this.#e())return;let i=await Promise.all(e.map(async s=>{if(!s.frames)return{run:s,problem:s.remedy??"This run has no recorded frames."};try{return{run:s,frames:await lp(s)}}catch(r){return{run:s,problem:`Its frames can't be read: ${r.message}`}}}));if(this.turn===t){if(i.forEach(({run:s,frames:r,problem:a},o)=>{let l=this.controls.cells[o];if(a)return this.controls.problem(l,a);let c=new sc(s,r,Xt().colours);this.views.push(c),this.cells.push({view:c,element:l}),Cg(l,h=>this.move(h,c),(h,f)=>this.#c(c,l,h,f)),l.addEventListener("focus",()=>{this.focused=c})}),this.controls.showRuns(e),!this.views.length)return this.controls.disable();this.first=Math.min(...this.views.map(s=>s.frames.times[0])),this.last=Math.max(...this.views.map(s=>s.frames.times.at(-1))),this.time=Math.min(Math.max(this.time,this.first),this.last),this.controls.ready(),this.#s(),this.#t(t),!j1.matches&&!this.played&&this.last>this.first&&this.#n(t)}}async#t(t){let e=()=>this.turn===t&&!this.disposed;await Promise.all(this.views.map(i=>i.frames.decodeAll(e))),e()&&(this.decoded=!0,this.#a(),this.draw(),this.element.dataset.decoded="")}async#n(t){for(;!this.decoded&&this.turn===t;)await new Promise(e=>setTimeout(e,50));this.turn===t&&!this.played&&!this.disposed&&this.play()}show(t){return this.shownIds=t.slice(0,8),this.shownIds.includes(this.referenceId)||(this.referenceId=null),this.decoded=!1,delete this.element.dataset.decoded,this.start()}#e(){if(this.stage)return!0;try{this.stage=new cc(this.controls.canvas)}catch{return this.controls.disable("The cloth can't be drawn: this browser has no WebGL 2. Use a newer browser, or turn on hardware acceleration in the settings of this browser."),!1}let{maps:t}=Xt().colours;return this.textures=Object.fromEntries(Object.entries(t).map(([e,i])=>[e,lg(i)])),this.controls.canvas.addEventListener("webglcontextlost",e=>e.preventDefault()),this.controls.canvas.addEventListener("webglcontextrestored",()=>{this.#s()}),!0}#i(){for(let t of this.views)t.dispose();this.views=[],this.cells=[],this.focused=null,this.compare.ranges.clear()}get reference(){return this.views.find(t=>t.run.id===this.referenceId)??null}#s(){if(!this.stage||!this.views.length)return;let{stage:t}=this.controls,e=this.isFull(),i=t.clientWidth,s=this.controls.cells.length;this.controls.layOut(Zl(s,i),Math.ceil(s/Zl(s,i)),e?null:Ag(s,i,innerHeight));let r=t.clientHeight;if(!i||!r)return;this.stage.resize(i,r),this.#r();let a=t.getBoundingClientRect();for(let o of this.cells){let l=o.element.getBoundingClientRect();Object.assign(o,{x:l.left-a.left,y:l.top-a.top,width:l.width,height:l.height})}this.#a(),this.drawNow(!0,!0),this.draw()}#a(){if(!this.cells.length||!this.cells[0].width)return;let t=Dg(this.views);if(this.linked){let e=Math.min(...this.cells.map(({width:r,height:a})=>r/a)),[i,...s]=this.views;i.orbit.frame(t.flat(),e);for(let r of s)r.orbit.copy(i.orbit)}else this.cells.forEach(({view:e,width:i,height:s},r)=>e.orbit.frame(t[r],i/s))}#r=()=>{if(!this.stage)return;let t=getComputedStyle(this.element);for(let e of["top","bottom"]){let i=t.getPropertyValue(`--stage-${e}`).trim()||"#f2f4f6";this.stage.ground[e].set(...[1,3,5].map(s=>parseInt(i.slice(s,s+2),16)/255))}this.draw()};#l=()=>{this.#r(),this.drawNow()};move(t,e=this.focused??this.views[0]){if(e){if(t(e.orbit),this.linked)for(let i of this.views)i!==e&&i.orbit.copy(e.orbit);this.draw()}}setLinked(t){this.linked=t;let e=(this.focused??this.views[0])?.orbit;if(t&&e)for(let i of this.views)i.orbit.copy(e);this.controls.update(),this.draw()}resetCameras(){for(let t of this.views)t.orbit.reset();this.#a(),this.draw()}isFull(){return document.fullscreenElement===this.element||this.element.classList.contains("player-filling")}async fullScreen(){if(this.isFull())this.element.classList.remove("player-filling"),document.fullscreenElement&&await document.exitFullscreen();else try{await this.element.requestFullscreen()}catch{this.element.classList.add("player-filling")}this.controls.update(),this.#s()}seek(t){this.views.length&&(this.time=Math.min(Math.max(t,this.first),this.last),this.draw())}step(t){if(!this.views.length)return;this.stop();let e=[...new Set(this.views.flatMap(s=>[...s.frames.times]))].sort((s,r)=>s-r),i=e.findLastIndex(s=>s<=this.time+1e-9);i=Math.min(Math.max(i+t,0),e.length-1),this.seek(e[i])}toggle(){this.playing?this.stop():this.play()}play(){if(!this.views.length||this.playing)return;this.played=!0,this.time>=this.last-1e-9&&(this.time=this.first),this.playing=!0,this.controls.update();let t=null,e=i=>{this.playing&&(t!==null&&(this.changed&&this.stage.judge(i-t),this.#h((i-t)/1e3*this.speed)),t=i,this.changed=this.drawNow(!0),this.playing?requestAnimationFrame(e):this.draw())};requestAnimationFrame(e)}#h(t){this.time+=t,!(this.time<this.last)&&(this.loop?this.time=this.first+(this.time-this.last)%Math.max(this.last-this.first,1e-9):(this.time=this.last,this.playing=!1,this.controls.update()))}stop(){this.played=!0,this.playing&&(this.playing=!1,this.controls.update(),this.draw())}setSpeed(t){this.speed=t,this.controls.update()}changeSpeed(t){let e=sa.findIndex(([i])=>i===this.speed)+t;this.setSpeed(sa[Math.min(Math.max(e,0),sa.length-1)][0])}setLoop(t){this.loop=t,this.controls.update()}setQuantity(t){this.key=t,this.controls.update(),this.draw()}nextQuantity(t){let e=this.compare.choices(this.reference).map(i=>i.key);this.setQuantity(e[(e.indexOf(this.key)+t+e.length)%e.length])}setReference(t){let e=this.referenceId;this.referenceId=t,t&&!e&&(this.key="distance"),!t&&this.key==="distance"&&(this.key="stretch");for(let i of this.views){let s=this.reference&&i!==this.reference?this.compare.map(i,this.reference):null;i.overlay(s?this.reference:null),this.controls.note(i,this.reference&&i!==this.reference&&!s?"another cloth: not comparable":i===this.reference?"the other runs are compared with this run":"")}this.controls.update(),this.draw()}nextReference(){let t=[null,...this.views.map(e=>e.run.id)];t.length>2&&this.setReference(t[(t.indexOf(this.referenceId)+1)%t.length])}setRange(t,e){this.compare.setRange(this.key,this.reference,[t,e]),this.draw()}setLines(t){this.lines=t,this.controls.update(),this.draw()}draw(){this.disposed||(clearTimeout(this.refining),!this.asked&&(this.asked=!0,requestAnimationFrame(()=>{this.asked=!1,!(this.playing||this.recorder.recording)&&(this.drawNow(!0,!0),this.refining=setTimeout(()=>this.playing||this.recorder.recording||this.drawNow(),J1))})))}drawNow(t=!1,e=!t){if(!this.stage||!this.views.length||this.disposed||!this.cells[0].width)return!1;let i=!1;for(let l of this.views)i=l.goTo(this.time)||i;if(!e&&!i)return!1;let{reference:s}=this,r=this.compare.quantity(this.key,s),a=r.map?this.compare.range(this.key,this.views,s):[0,1];for(let l of this.views){let c=`${l.frame} ${s?.run.id} ${s?.frame} ${this.key}`;if(l.coloured!==c){let f=this.compare.values(this.key,l,s);l.cloth.colour(f?.values??null,f?.smooth),l.coloured=c}let{uniforms:h}=l.cloth.material;h.map.value=r.map?this.textures[r.map]:null,h.range.value=a,h.logarithmic.value=r.scale==="log",h.lines.value=this.lines}this.stage.draw(this.cells,t),++this.drawn;let o=performance.now();return(!this.playing||!(o-this.reportedAt<K1))&&(this.controls.tell(r,a),this.reportedAt=o),(!this.playing||this.drawn%8===0)&&this.#o(),i}#c(t,e,i,s){e.focus({preventScroll:!0});let{camera:r}=t,a={width:e.clientWidth,height:e.clientHeight},o=r.position.clone(),l=new F(2*i/a.width-1,1-2*s/a.height,.5).unproject(r).sub(o).normalize(),c=ug(o.toArray(),l.toArray(),t.cloth.positions,t.mesh.triangles);if(!c)return this.clearPick();let h=c.shares.indexOf(Math.max(...c.shares));this.pick(t,t.mesh.triangles[3*c.triangle+h],c.triangle)}async pick(t,e,i){let s=this.pickTurn={},r=this.views.map(a=>{if(a===t)return{other:a,vertex:e,triangle:i};let o=this.compare.map(t,a);return o?{other:a,vertex:o.vertex(e),triangle:i===null?null:o.face(i)}:{other:a,vertex:null,triangle:null}});for(let{other:a,vertex:o,triangle:l}of r)a.picked.set(o,l,null);this.draw(),this.#o();for(let{other:a,vertex:o,triangle:l}of r){if(o===null)continue;a.springs??=Promise.all(Object.values(a.frames.head.springs.kinds).map(async h=>({columns:a.frames.head.sections[h].columns,vertices:await a.frames.array(h)})));let c=await a.springs;if(this.pickTurn!==s||this.disposed)return;a.picked.set(o,l,Fg(a.mesh,c,o))}this.draw(),this.#o()}pickNumber(t,e){let i=this.focused??this.views[0];if(!i)return;let s=t==="vertex"?i.mesh.vertexCount:i.mesh.triangleCount,r=Math.min(Math.max(Math.round(e)||0,0),s-1);t==="vertex"?this.pick(i,r,i.mesh.around.list[i.mesh.around.first[r]]??null):this.pick(i,i.mesh.triangles[3*r],r)}askFor(t){this.hasPick()||this.pickNumber(t,0),this.#o(),this.controls.panel[t].focus(),this.controls.panel[t].select()}hasPick(){return this.views.some(t=>t.picked.vertex!==null)}clearPick(){this.pickTurn={};let t=this.controls.panel.element.contains(document.activeElement);for(let e of this.views)e.picked.set(null,null,[]);this.#o(),this.draw(),t&&this.controls.cells[0].focus({preventScroll:!0})}#o(){if(!this.hasPick()&&this.controls.panel.element.hidden)return;let{reference:t}=this,e=[],i=(r,a,o)=>{let l=this.compare.values(r,a,t);return l?l.values[l.smooth?a.picked.vertex:a.picked.triangle]??NaN:NaN};t&&e.push({of:"vertex",name:`distance to ${t.run.label} (m)`,text:r=>r===t?"\u2013":Vt(i("distance",r),4)});for(let r of["strain","quality","bending"]){let a=this.compare.quantity(r,null);e.push({of:"triangle",name:`${a.name.toLowerCase()} ${a.symbol}`,text:o=>pn(this.compare.values(r,o,null).values[o.picked.triangle]??NaN,a.unit,4)})}this.views.some(r=>r.frames.head.rigidity)&&e.push({of:"triangle",name:"bending energy as stated (J/m\xB2)",text:r=>Vt((r.frames.head.rigidity??NaN)*(this.compare.values("bending",r,null).values[r.picked.triangle]??NaN),3)}),this.controls.panel.show(this.views,e)}saveStill(){return this.recorder.still()}saveAnimation(){return this.recorder.animation()}showKeys(){this.controls.showKeys()}dispose(){this.stop(),clearTimeout(this.refining),this.disposed=!0,this.turn=null,this.resizes.disconnect(),this.theme.removeEventListener("change",this.#r),this.print.removeEventListener("change",this.#l),this.#i();for(let t of Object.values(this.textures??{}))t.dispose();this.stage?.dispose(),this.stage=null}};function Gg(n){if(n.player)return n.player;let t=n.player=new hc(n),e=new IntersectionObserver(i=>{i.some(s=>s.isIntersecting)&&(e.disconnect(),t.disposed||t.start())},{rootMargin:"200px"});return e.observe(n),t}function Hg(){for(let n of document.querySelectorAll(".player"))Gg(n);document.addEventListener("bendlab:player",({detail:n})=>Gg(n.element)),document.addEventListener("bendlab:discard",({detail:n})=>n.element?.player?.dispose())}Kd(()=>{Jd(),sp(),Hg(),hp()});})();
